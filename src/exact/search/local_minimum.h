// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "exact/layout.h"
#include "simd/kernels.h"

namespace meshhood {

/// A vertex of the ball that may be the nearest of its component: it has no nearer neighbour.
struct LocalMinimum {
  double square;  // of its distance, as the predicate has it
  LeafId leaf;
  unsigned lane;
};

/// Appends the local minima of `leaf`, the query vertex at `slot` aside. Of vertices that hang together within leaf
/// and ball, the nearest stands for all. Nothing is in doubt where distances tie: they are those of the predicate.
void append_local_minima(const IndexView& index, const Kernels& kernels, LeafId leaf, std::uint32_t slot,
                         const LeafBall& ball, std::vector<LocalMinimum>& out);

}  // namespace meshhood
