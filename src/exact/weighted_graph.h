// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/adjacency.h"

namespace meshhood {

struct IndexView;

/// The graph of an index with the length of each edge. Vertices are named by their place in index order, so neighbors
/// lie near each other in memory. 80 bytes for a vertex with six neighbors.
struct WeightedGraph {
  Adjacency edges;              // rows ascend
  std::vector<double> lengths;  // by element of `edges.neighbors`
};

/// O(#V + #E).
[[nodiscard]] WeightedGraph make_weighted_graph(const IndexView& index);

}  // namespace meshhood
