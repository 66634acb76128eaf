// SPDX-License-Identifier: MIT
#include "exact/query/any_center.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

// Spheres and vertices lie within 4 of the origin of the frame. The center, its distance from that of the sphere, and
// the predicate are each rounded a few times by 2^-53 of the distance plus 4. This covers a thousand such errors.
constexpr double kRangeSlack = 0x1p-43;

// This covers the underflow of squares, here and in the predicate.
constexpr double kSmallestSquare = 0x1p-1000;

}  // namespace

SquareRange squared_distances(const FrameSphere& sphere, const Center& center) {
  const Point middle{static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)};
  const double distance = length(center.in_frame - middle);
  const double slack = kRangeSlack * (distance + 4);
  const double reach = static_cast<double>(sphere.radius) + slack;
  const double near = (distance - reach) * center.unit;
  const double far = (distance + reach) * center.unit;
  // A center so far away that its distance overflows gives no bounds: infinity less infinity is not > 0.
  const double low = near > 0 ? std::max(near * near * (1 - kRangeSlack) - kSmallestSquare, 0.0) : 0.0;
  return {low, far * far * (1 + kRangeSlack) + kSmallestSquare};
}

LeafBall any_ball(const Point& center, double radius) {
  LeafBall ball(center, LeafBounds(radius));
  const Point rounded{static_cast<double>(ball.x), static_cast<double>(ball.y), static_cast<double>(ball.z)};
  const double shift = length(center - rounded) * (1 + 0x1p-40);
  if (shift == 0) return ball;
  // The filter measures from the rounded center: a vertex within `radius - shift` of it is surely inside, one beyond
  // `radius + shift` surely outside. If the shift overflows, the predicate decides all vertices.
  ball.surely_inside =
      radius > shift ? LeafBounds(radius - shift).surely_inside : -std::numeric_limits<float>::infinity();
  ball.surely_outside = LeafBounds(radius + shift).surely_outside;
  return ball;
}

}  // namespace meshhood::inline v0_1
