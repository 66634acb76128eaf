// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
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

/// The graph of an index vertex by vertex, made at its first use and kept for all searchers: for paths along the edges,
/// and for odd graphs.
///
/// Any thread may ask for it. There is no lock, because a fork could leave it held: if several threads make the graph
/// at once, one result is kept. O(#V + #E) the first time.
class KeptGraph {
 public:
  KeptGraph() = default;
  KeptGraph(const KeptGraph&) = delete;
  KeptGraph& operator=(const KeptGraph&) = delete;
  ~KeptGraph();

  [[nodiscard]] const WeightedGraph& of(const IndexView& index);

 private:
  std::atomic<const WeightedGraph*> graph_{nullptr};
};

}  // namespace meshhood
