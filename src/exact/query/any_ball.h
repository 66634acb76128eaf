// SPDX-License-Identifier: MIT
#pragma once

#include "simd/ball.h"

namespace meshhood {

/// A ball to be compared with vertices, whose center need not be a vertex: `LeafBall` by itself assumes that the center
/// is exact in single precision where the positions are floats.
[[nodiscard]] LeafBall any_ball(const Point& center, double radius);

}  // namespace meshhood
