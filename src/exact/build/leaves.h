// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/adjacency.h"

#include "base/frame.h"
#include "base/parallel.h"

namespace meshhood {

/// Which vertices make up a leaf, and the order of the leaves and of their vertices.
struct LeafPartition {
  std::vector<std::uint32_t> slot;    // by the caller's vertex: 32 times its leaf, plus its lane
  std::vector<VertexId> permutation;  // in index order: the caller's vertex
  std::vector<VertexId> leaf_begin;   // by leaf, and one more
};

/// Cuts the vertices into leaves of at most 32 that lie close together and, wherever the mesh allows it without leaves
/// of a few vertices, are connected. Eight, sixty-four, ... consecutive leaves lie close together again.
/// The graph is valid. Throws Error{TooLarge} beyond `kMaxLeaves`. O(#V log #V + #E).
[[nodiscard]] LeafPartition make_leaves(const GraphView& graph, const Frame& frame, TaskContext& task);

/// Throws Error{TooLarge} unless the places in so many leaves are numbers of 32 bits.
void check_leaf_count(std::size_t leaves);

}  // namespace meshhood
