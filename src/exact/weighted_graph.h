// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/vertex_id.h"

#include "shared/kept.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

struct IndexView;

/// All edges; rows ascend. A vertex is named by its place in index order, or by what `names` has there. Polls `task`.
[[nodiscard]] Adjacency gather_edges(const IndexView& index, std::span<const VertexId> names, TaskContext& task);

/// The graph of an index with the length of each edge. Vertices are named by their place in index order, so neighbors
/// lie near each other in memory. 80 bytes for a vertex with six neighbors.
struct WeightedGraph {
  std::shared_ptr<const Adjacency> edges;  // rows ascend
  std::vector<double> lengths;             // by element of `edges->neighbors`
};

/// The graph of an index vertex by vertex, made at its first use and kept for all searchers: for paths along the edges,
/// and for odd graphs. Any thread may ask for it. O(#V + #E) the first time.
class KeptGraph {
 public:
  KeptGraph() = default;
  explicit KeptGraph(WeightedGraph graph);
  /// With these edges, or null for those of the index. Their lengths are made at the first use.
  explicit KeptGraph(std::shared_ptr<const Adjacency> edges) : edges_(std::move(edges)) {}

  /// Null if they have not been made.
  [[nodiscard]] std::shared_ptr<const Adjacency> edges() const { return graph_.made() ? graph_.made()->edges : edges_; }

  [[nodiscard]] const WeightedGraph& of(const IndexView& index);

  /// Renews the lengths after vertices of `index` have moved, given by their places in index order. While no other
  /// thread uses it. O(edges of `moved`).
  void renew(const IndexView& index, std::span<const VertexId> moved);

 private:
  std::shared_ptr<const Adjacency> edges_;  // if they are known before the lengths
  Kept<WeightedGraph> graph_;
};

}  // namespace meshhood::inline v0_1
