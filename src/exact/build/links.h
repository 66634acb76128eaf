// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/adjacency.h"

#include "base/parallel.h"
#include "exact/build/leaves.h"
#include "exact/layout.h"

namespace meshhood {

/// The edges of the mesh, as the leaves see them.
struct Links {
  std::vector<LaneMask> adjacency;      // in index order: the neighbours within the leaf
  std::vector<std::uint32_t> link_end;  // by leaf: where its links end
  std::vector<Link> links;              // one more, for the end of the last cross_edges
  std::vector<CrossEdge> cross_edges;
};

/// O(#V + #E log(edges that leave a leaf)).
[[nodiscard]] Links make_links(const AdjacencyView& adjacency, const LeafPartition& leaves, TaskContext& task);

/// Whether the first `size` vertices of a leaf hang together by the edges between them.
[[nodiscard]] bool is_connected(const LaneMask* adjacency, unsigned size);

}  // namespace meshhood
