// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// Returns a sphere around the points `xyz` (`#points by 3`, at least one), at most a thousandth larger than the
/// smallest, except that its center is rounded to `Real`. The radius is rounded up, so that every point is inside as
/// distances are computed. If all points coincide, the radius is 0. Takes O(#points): about ten passes, and never more
/// than 66.
template <class Real>
[[nodiscard]] Sphere<Real> bounding_sphere(std::span<const Real> xyz);

/// Returns the center of such a sphere around at least one point, not rounded.
[[nodiscard]] Point bounding_center(std::span<const Point> points);

}  // namespace meshhood::inline v0_1
