// SPDX-License-Identifier: MIT
#include "exact/query/any_ball.h"

#include <limits>

#include "base/vector.h"

namespace meshhood {

LeafBall any_ball(const Point& center, double radius) {
  LeafBall ball(center, LeafBounds(radius));
  const Point rounded{static_cast<double>(ball.x), static_cast<double>(ball.y), static_cast<double>(ball.z)};
  const double shift = length(center - rounded) * (1 + 0x1p-40);  // mutant: shift-of-center-ignored
  if (shift == 0) return ball;
  // The filter measures from the rounded center: a vertex within `radius - shift` of it is surely inside, one beyond
  // `radius + shift` surely outside. If the shift overflows, the predicate decides all vertices.
  ball.surely_inside =
      radius > shift ? LeafBounds(radius - shift).surely_inside : -std::numeric_limits<float>::infinity();
  ball.surely_outside = LeafBounds(radius + shift).surely_outside;
  return ball;
}

}  // namespace meshhood
