// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "shared/distance.h"

namespace meshhood {

/// The point of a triangle that is nearest to another point.
struct TrianglePoint {
  std::array<double, 3> weights;  // barycentric
  Point point;
  double distance;
};

/// The point of the triangle `a`, `b`, `c` nearest to `q`. `scale` makes lengths of the mesh about 1, so that products
/// do not overflow; a power of two. For a corner, the distance is that of the predicate. Triangles that share a side or
/// a corner have the same distance there, bit for bit, whatever the order of their corners.
[[nodiscard]] TrianglePoint nearest_in_triangle(const Point& q, const std::array<Point, 3>& corners, double scale);

}  // namespace meshhood
