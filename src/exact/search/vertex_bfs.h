// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "meshhood/adjacency.h"
#include "meshhood/reference.h"

#include "base/number_set.h"
#include "exact/layout.h"
#include "exact/vertex_set.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {

/// Returns whether leaves have many links of few edges, as around hubs and in random graphs. A step from leaf to leaf
/// then reaches few vertices, and breadth-first search over vertices is faster at every radius.
[[nodiscard]] bool is_unlike_a_surface(const IndexView& index);

/// Returns whether `VertexBfs` answers every query: the graph is unlike a surface, has no edges, or squared distances
/// can underflow.
[[nodiscard]] bool is_odd(const IndexView& index);

/// Breadth-first search over vertices, for odd graphs: the reference search, on a copy of the graph in index order. All
/// searchers of an index share the copy, which the first query makes.
class VertexBfs {
 public:
  VertexBfs(const IndexView& index, KeptGraph& graph) : index_(&index), graph_(&graph) {}

  /// Adds the neighborhood of `v` to `answer`, which is empty. `squared_radius` is that of the predicate.
  void run(VertexId v, double squared_radius, VertexSet& answer);

 private:
  void make_searcher();

  const IndexView* index_;
  KeptGraph* graph_;
  std::optional<ReferenceSearcher> searcher_;
  std::optional<NumberSet> found_;  // in index order
};

}  // namespace meshhood::inline v0_1
