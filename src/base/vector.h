// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "base/distance.h"

namespace meshhood {

// Vector arithmetic on points. Every operation is rounded on its own, in the order written.

[[nodiscard]] inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
[[nodiscard]] inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
[[nodiscard]] inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }

[[nodiscard]] inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

[[nodiscard]] inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace meshhood
