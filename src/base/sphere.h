// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "base/distance.h"

namespace meshhood {

/// The smallest sphere around the points `xyz` (`#points by 3`, at least one) to within a thousandth of its radius; the
/// centre is rounded to `Real`, and the radius upwards, so that every point lies within it as distances are computed.
/// A single point, however often repeated, has radius 0. Always ends; O(#points), about ten passes.
template <class Real>
[[nodiscard]] Sphere<Real> bounding_sphere(std::span<const Real> xyz);

}  // namespace meshhood
