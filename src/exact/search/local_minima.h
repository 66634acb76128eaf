// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/query.h"
#include "simd/kernels.h"

namespace meshhood {

/// A vertex of the ball without a neighbour that is nearer to the query vertex.
struct LocalMinimum {
  double square;  // of its distance, by the predicate
  LeafId leaf;
  unsigned lane;
};

/// Refills `out` with local minima in `leaves`, ascending by distance: at least one of the nearest vertices of every
/// component of the ball that has all its nearest vertices in `leaves`, except the component of the query vertex.
///
/// Of vertices that are connected within a leaf and the ball, only the nearest is tested. Leaves around the query
/// vertex that are known to be connected with it are skipped.
void find_local_minima(const IndexView& index, const Kernels& kernels, std::span<const LeafId> leaves,
                       const Query& query, std::vector<LocalMinimum>& out);

}  // namespace meshhood
