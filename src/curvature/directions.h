// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace meshhood {

[[nodiscard]] inline Point unit(const Point& a) { return (1 / length(a)) * a; }

/// The vector, or its negative: the one whose component of largest magnitude is positive.
[[nodiscard]] inline Point with_sign(const Point& a) {
  const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  const bool negative = a.x == -largest || (a.x != largest && (a.y == -largest || (a.y != largest && a.z < 0)));
  return negative ? -1 * a : a;
}

}  // namespace meshhood
