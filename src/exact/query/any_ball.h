// SPDX-License-Identifier: MIT
#pragma once

#include "simd/ball.h"

namespace meshhood {

/// A ball to be compared with vertices, whose centre need not be a vertex: `LeafBall` by itself assumes that the centre
/// is exact in single precision where the positions are floats.
[[nodiscard]] LeafBall any_ball(const Point& centre, double radius);

}  // namespace meshhood
