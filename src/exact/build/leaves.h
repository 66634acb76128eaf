// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "meshhood/mesh.h"

#include "base/frame.h"
#include "exact/build/edge_source.h"
#include "exact/build/forest.h"
#include "exact/build/links.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// The vertices of each leaf, the order of leaves and of vertices in them, which is the index order, and the edges.
struct LeafPartition {
  Forest forest;                     // whose groups the leaves are numbered by
  RawVector<std::uint32_t> slot;     // by the caller's vertex: 32 times its leaf plus its lane
  RawVector<VertexId> permutation;   // in index order: the caller's vertex
  std::vector<VertexId> leaf_begin;  // by place of a leaf, and one more: its first vertex in index order
  Links links;                       // by place of a leaf
};

/// Divides the vertices into leaves of 1 to 32 vertices that lie close together and are connected; small components of
/// the mesh share leaves. Groups the leaves. Vertices within a leaf keep the caller's order. Reports three steps:
/// cells, their edges, leaves.
///
/// positions, edges  valid
/// frame             the frame of the positions
/// Throws Error{TooLarge} for more than `kMaxLeaves` leaves, and Error{Cancelled}. O(#V log #V + #E).
[[nodiscard]] LeafPartition make_leaves(const PositionsView& positions, const EdgeSource& edges, const Frame& frame,
                                        TaskContext& task);

/// Throws Error{TooLarge} if the slots of so many leaves do not fit into 32 bits.
void check_leaf_count(std::size_t leaves);

}  // namespace meshhood::inline v0_1
