// SPDX-License-Identifier: MIT
#pragma once

#include "exact/layout.h"
#include "simd/kernels.h"

namespace meshhood {

/// A ball in which hardly a leaf lies inside, so that a flood looks at no more leaves than a descent, and knows all of
/// them as soon as it has seen the neighbours of the first.
[[nodiscard]] inline bool is_small(const TreeBall& ball, const IndexView& index) {
  constexpr double kMeanLeafRadii = 1.8;
  return static_cast<double>(ball.inner) < kMeanLeafRadii * index.tree[0].mean_radius;
}

}  // namespace meshhood
