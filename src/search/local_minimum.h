// SPDX-License-Identifier: MIT
#pragma once

#include "index/layout.h"
#include "search/simd.h"

namespace meshhood {

/// Whether `leaf` may hold a vertex of the ball, other than the query vertex at `place`, that could be the nearest of
/// its component: one without a nearer neighbour. Distances are those of the predicate, so that the answer is not in
/// doubt where they tie.
[[nodiscard]] bool has_local_minimum(const IndexStorage& index, const Kernels& kernels, LeafId leaf,
                                     std::uint32_t place, const LeafBall& ball);

}  // namespace meshhood
