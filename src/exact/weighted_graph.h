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

/// Returns all edges; rows ascend. A vertex is named by its place in index order, or by what `names` has there. Polls
/// `task`.
[[nodiscard]] Adjacency gather_edges(const IndexView& index, std::span<const VertexId> names, TaskContext& task);

/// The graph of an index with the length of each edge. Vertices are named by their place in index order, so neighbors
/// lie near each other in memory. A vertex with six neighbors takes 76 bytes.
struct WeightedGraph {
  std::shared_ptr<const Adjacency> edges;  // rows ascend
  std::vector<double> lengths;             // by element of `edges->neighbors`
};

/// Holds the graph of an index vertex by vertex, made at its first use and kept for all searchers: for paths, and the
/// edges for odd graphs. Any thread may ask for it. The first time takes O(#V + #E).
class KeptGraph {
 public:
  KeptGraph() = default;
  /// Takes these edges, or null for those of the index. Their lengths are made at the first use.
  explicit KeptGraph(std::shared_ptr<const Adjacency> edges);
  /// Takes these edges, and another graph for paths. Its lengths are given; they may depend on the direction.
  KeptGraph(std::shared_ptr<const Adjacency> edges, WeightedGraph paths);

  /// Returns the edges, or null if they have not been made.
  [[nodiscard]] std::shared_ptr<const Adjacency> edges() const { return edges_.made() ? *edges_.made() : nullptr; }

  [[nodiscard]] const std::shared_ptr<const Adjacency>& edges_of(const IndexView& index);

  /// Returns the graph in which paths are searched: that of the edges, unless another was given.
  [[nodiscard]] const WeightedGraph& paths_of(const IndexView& index);

  /// Renews the lengths of the edges after vertices of `index` have moved, given by their places in index order. No
  /// other thread may use it meanwhile. Takes O(edges of `moved`).
  void renew(const IndexView& index, std::span<const VertexId> moved);

 private:
  Kept<std::shared_ptr<const Adjacency>> edges_;
  Kept<WeightedGraph> paths_;
};

}  // namespace meshhood::inline v0_1
