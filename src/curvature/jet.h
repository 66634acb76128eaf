// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "curvature/packet_moments.h"
#include "curvature/quadric.h"
#include "shared/distance.h"

/// The jet z = f + d x + e y + a x^2 + b x y + c y^2 over the plane of the principal components of its points. Its
/// curvatures are those of the quadric without f: the constant moves the surface, but does not bend it.
namespace meshhood {

/// The axes of the principal components, that of the least variance as `n`, on the side of `normal`.
[[nodiscard]] TangentFrame jet_frame(const Eigen3& axes, const Point& normal);

/// The fit to `points`, relative to the query vertex, and its frame.
struct JetFit {
  TangentFrame frame;
  PointFit fit;
};
[[nodiscard]] JetFit fit_jet(std::span<const Point> points, const Point& normal);

}  // namespace meshhood
