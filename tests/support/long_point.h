// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "shared/distance.h"

namespace meshhood::test {

/// Points in long double, for references that shall be more accurate than what they test.
using Long = long double;
using LongPoint = std::array<Long, 3>;

[[nodiscard]] inline LongPoint operator-(const LongPoint& a, const LongPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline LongPoint operator+(const LongPoint& a, const LongPoint& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline LongPoint operator*(Long s, const LongPoint& a) { return {s * a[0], s * a[1], s * a[2]}; }

[[nodiscard]] inline Long dot_of(const LongPoint& a, const LongPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] inline LongPoint cross_of(const LongPoint& a, const LongPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline LongPoint minus(const Point& a, const Point& b) {
  return {static_cast<Long>(a.x) - static_cast<Long>(b.x), static_cast<Long>(a.y) - static_cast<Long>(b.y),
          static_cast<Long>(a.z) - static_cast<Long>(b.z)};
}

}  // namespace meshhood::test
