// SPDX-License-Identifier: MIT
#include "curvature/jet.h"

#include <array>
#include <vector>

#include "base/vector.h"
#include "curvature/least_squares.h"

namespace meshhood {

TangentFrame jet_frame(const Eigen3& axes, const Point& normal) {
  const Point n = dot(axes.vectors[0], normal) < 0 ? -1 * axes.vectors[0] : axes.vectors[0];
  const Point& u = axes.vectors[2];
  return {u, cross(n, u), n};
}

JetFit fit_jet(std::span<const Point> points, const Point& normal) {
  Point sum{0, 0, 0};
  for (const Point& p : points) sum = sum + p;
  const Point center = (1 / static_cast<double>(points.size())) * sum;
  Symmetric3 covariance{0, 0, 0, 0, 0, 0};
  for (const Point& p : points) {
    const Point q = p - center;
    covariance = {covariance.xx + q.x * q.x, covariance.xy + q.x * q.y, covariance.xz + q.x * q.z,
                  covariance.yy + q.y * q.y, covariance.yz + q.y * q.z, covariance.zz + q.z * q.z};
  }
  const TangentFrame frame = jet_frame(eigen(covariance), normal);
  std::array<std::vector<double>, 7> columns;
  for (const Point& p : points) {
    const double x = dot(p, frame.u);
    const double y = dot(p, frame.v);
    const std::array<double, 7> row{x * x, x * y, y * y, x, y, 1, dot(p, frame.n)};
    for (std::size_t j = 0; j < row.size(); ++j) columns[j].push_back(row[j]);
  }
  const RowFit<6> fit = fit_rows<6>(columns);
  const auto& [a, b, c, d, e, f] = fit.solution;
  return {frame, {{a, b, c, d, e}, fit.unique}};
}

}  // namespace meshhood
