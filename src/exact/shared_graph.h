// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "meshhood/adjacency.h"

#include "exact/weighted_graph.h"

namespace meshhood {

struct IndexView;

/// Graphs of an index, each made at its first use and kept for all searchers.
///
/// Any thread may ask for one. There is no lock, because a fork could leave it held: if several threads make a graph at
/// once, one result is kept. O(#V + #E) the first time. `index` owns this object.
class SharedGraph {
 public:
  SharedGraph() = default;
  SharedGraph(const SharedGraph&) = delete;
  SharedGraph& operator=(const SharedGraph&) = delete;
  ~SharedGraph();

  /// The graph in the caller's order.
  [[nodiscard]] const GraphData& of(const IndexView& index);

  /// The graph in index order, with the lengths of the edges.
  [[nodiscard]] const WeightedGraph& weighted(const IndexView& index);

 private:
  std::atomic<const GraphData*> graph_{nullptr};
  std::atomic<const WeightedGraph*> weighted_{nullptr};
};

}  // namespace meshhood
