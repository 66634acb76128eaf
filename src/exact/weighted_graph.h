// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/adjacency.h"

#include "shared/kept.h"

namespace meshhood {

struct IndexView;

/// The graph of an index with the length of each edge. Vertices are named by their place in index order, so neighbors
/// lie near each other in memory. 80 bytes for a vertex with six neighbors.
struct WeightedGraph {
  Adjacency edges;              // rows ascend
  std::vector<double> lengths;  // by element of `edges.neighbors`
};

/// The graph of an index vertex by vertex, made at its first use and kept for all searchers: for paths along the edges,
/// and for odd graphs. Any thread may ask for it. O(#V + #E) the first time.
class KeptGraph {
 public:
  [[nodiscard]] const WeightedGraph& of(const IndexView& index);

 private:
  Kept<WeightedGraph> graph_;
};

}  // namespace meshhood
