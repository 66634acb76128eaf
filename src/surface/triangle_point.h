// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <tuple>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// A point of a triangle, and its distance from another point.
struct TrianglePoint {
  std::array<double, 3> barycentric;
  Point point;
  double distance;
};

/// A fixed order of points, in which all triangles that have a side see its ends.
[[nodiscard]] inline bool is_before(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Which share of the way from `a` to `b` leads to the point nearest to the origin. Ends have exactly 0 and 1.
[[nodiscard]] double share_of_side(const Point& a, const Point& b);

/// The number of the longest of three sides.
[[nodiscard]] std::size_t longest(const std::array<Point, 3>& sides);

/// The point of the triangle `a`, `b`, `c` nearest to `q`. `scale` makes lengths of the mesh about 1, so that products
/// do not overflow; a power of two. For a corner, the distance is that of the predicate. Triangles that share a side or
/// a corner have the same distance there, bit for bit, whatever the order of their corners.
[[nodiscard]] TrianglePoint nearest_in_triangle(const Point& q, const std::array<Point, 3>& corners, double scale);

/// Boxes farther than this from a point have no triangle nearer than `distance`; both in the frame. The distance of a
/// triangle is off by a few units in the last place of itself and of the sides, which are at most 4 there, and squares
/// of distances may vanish.
[[nodiscard]] inline double reach_of(double distance, double scale) {
  constexpr double kSlack = 0x1p-43;
  constexpr double kUnderflow = 0x1p-535;
  return distance + kSlack * (distance + 4) + kUnderflow * scale;
}

}  // namespace meshhood::inline v0_1
