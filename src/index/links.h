// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/adjacency.h"

#include "index/layout.h"
#include "index/leaves.h"
#include "parallel.h"

namespace meshhood {

/// The edges of the mesh, as the leaves see them.
struct Links {
  std::vector<Lanes> adjacency;         // in index order: the neighbours within the leaf
  std::vector<std::uint32_t> link_end;  // by leaf: where its links end
  std::vector<Link> links;              // one more, for the end of the last crossings
  std::vector<Crossing> crossings;
};

/// O(#V + #E log(edges that leave a leaf)).
[[nodiscard]] Links make_links(const AdjacencyView& adjacency, const LeafPartition& leaves, Work& work);

/// Whether the first `size` vertices of a leaf hang together by the edges between them.
[[nodiscard]] bool is_connected(const Lanes* adjacency, unsigned size);

}  // namespace meshhood
