// SPDX-License-Identifier: MIT
#include "curvature/quadric.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vector.h"
#include "curvature/least_squares.h"
#include "curvature/symmetric.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

double ratio(double numerator, double denominator) { return denominator > 0 ? numerator / denominator : kInfinity; }

}  // namespace

TangentFrame frame_of(const Point& normal) {
  // The coordinate axis that is farthest from the normal.
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  const Point axis = x <= y && x <= z ? Point{1, 0, 0} : (y <= z ? Point{0, 1, 0} : Point{0, 0, 1});
  const Point u = unit(axis - dot(axis, normal) * normal);
  return {u, cross(normal, u), normal};
}

TangentFrame frame_towards(const Point& normal, const Point& offset) {
  const Point in_plane = offset - dot(offset, normal) * normal;
  const double size = length(in_plane);
  if (!(size > 0)) return frame_of(normal);
  const Point u = {in_plane.x / size, in_plane.y / size, in_plane.z / size};
  return {u, unit(cross(normal, u)), normal};
}

double smallest_determinant(const FrameMoments& s, std::size_t query, const MomentSizes& sizes) {
  const auto at = [query](const QueryRow& row) { return row[query]; };
  // The relative errors of the elements of the normal equations are about epsilon times `amplification`. Measured,
  // results are then within 1e-9 of the exact ones.
  const double amplification = std::max(ratio(sizes.fourth, std::min({at(s.u4), at(s.u2v2), at(s.v4)})),
                                        ratio(sizes.second, std::min(at(s.uu), at(s.vv))));
  return 1e-6 * amplification;
}

PointFit fit_points(std::span<const Point> points) {
  std::array<std::vector<double>, 6> columns;
  for (std::vector<double>& column : columns) column.reserve(points.size());
  for (const Point& p : points) {
    const std::array<double, 6> row{p.x * p.x, p.x * p.y, p.y * p.y, p.x, p.y, p.z};
    for (std::size_t j = 0; j < row.size(); ++j) columns[j].push_back(row[j]);
  }
  const RowFit<5> fit = fit_rows<5>(columns);
  return {fit.solution, fit.unique};
}

PrincipalCurvature principal_curvature(const Quadric& quadric, const TangentFrame& frame,
                                       ShapeOperator shape_operator) {
  const auto [a, b, c, d, e] = quadric;
  // First fundamental form: E, F, G. Second: L, M, N.
  const double E = 1 + d * d;  // NOLINT(readability-identifier-naming): the names of the field
  const double F = d * e;      // NOLINT(readability-identifier-naming)
  const double G = 1 + e * e;  // NOLINT(readability-identifier-naming)
  const double determinant = 1 + d * d + e * e;
  const double s = 1 / std::sqrt(determinant);
  const double L = 2 * a * s;  // NOLINT(readability-identifier-naming)
  const double M = b * s;      // NOLINT(readability-identifier-naming)
  const double N = 2 * c * s;  // NOLINT(readability-identifier-naming)
  if (shape_operator == ShapeOperator::Libigl) {
    const Eigen2 result =
        eigen((L * G - M * F) / determinant, (M * E - L * F) / determinant, (N * E - M * F) / determinant);
    const auto direction = [&](const std::array<double, 2>& v) {
      return with_sign(unit(v[0] * frame.u + v[1] * frame.v));
    };
    PrincipalCurvature k{-result.low, -result.high, direction(result.low_vector), direction(result.high_vector)};
    if (k.k1 == 0) k.d1 = {0, 0, 0};
    if (k.k2 == 0) k.d2 = {0, 0, 0};
    return k;
  }
  // With I = C C^T, C = [[r, 0], [F / r, t]], the shape operator is similar to the symmetric C^-1 II C^-T, whose
  // eigenvectors q belong to the directions C^-T q.
  const double r = std::sqrt(E);
  const double t = std::sqrt(determinant) / r;  // EG - F^2 = determinant
  const double f = F / r;
  const double p = L / E;
  const double o = (M - f * L / r) / (r * t);
  const double q = (N - 2 * f * M / r + f * f * L / E) / (t * t);
  const Eigen2 result = eigen(p, o, q);
  const auto direction = [&](const std::array<double, 2>& v) {
    const double y = v[1] / t;
    const double x = (v[0] - f * y) / r;
    return with_sign(unit(x * frame.u + y * frame.v + (d * x + e * y) * frame.n));
  };
  return {-result.low, -result.high, direction(result.low_vector), direction(result.high_vector)};
}

}  // namespace meshhood
