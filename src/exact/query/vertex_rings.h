// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/epoch_array.h"
#include "base/number_set.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"

namespace meshhood {

/// The rings of one vertex, vertex by vertex, for graphs unlike a surface: their leaves have so few vertices in common
/// with a ring that words for each leaf take longer. O(edges of the answer). One object a thread; owns 8 bytes a
/// vertex.
class VertexRings {
 public:
  VertexRings(const IndexView& index, KeptGraph& graph)
      : index_(&index), graph_(&graph), edges_to_(index.vertex_count()), found_(index.vertex_count()) {}

  /// Finds the vertices that at most `rings` edges separate from the vertex at `slot`, by no wall. Returns how many
  /// there are, without the ignored ones.
  std::size_t run(std::uint32_t slot, std::uint32_t rings);

  /// Calls `f(vertex, edges)` once for each of them, by its place in index order, ascending.
  template <class F>
  void take(F&& f) {
    found_.take_all([&](std::size_t vertex) { f(vertex, edges_to_[vertex]); });
  }

 private:
  const IndexView* index_;
  KeptGraph* graph_;
  EpochArray<std::uint32_t> edges_to_;  // by place
  NumberSet found_;
  std::vector<std::uint32_t> queue_;
};

}  // namespace meshhood
