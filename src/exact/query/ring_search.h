// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "base/number_set.h"
#include "exact/joint/packet_answer.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {

/// Finds the rings of one vertex, vertex by vertex, for graphs unlike a surface: their leaves have so few vertices in
/// common with a ring that words for each leaf take longer. Takes O(edges of the answer). Each thread needs its own,
/// which owns 8 bytes a vertex.
class VertexRings final : public PacketLengths {
 public:
  VertexRings(const IndexView& index, KeptGraph& graph)
      : index_(&index), graph_(&graph), edges_to_(index.vertex_count()), found_(index.vertex_count()) {}

  /// Finds the vertices that at most `rings` edges separate from the vertex at `slot`, by no wall. Returns how many
  /// there are, without the ignored ones.
  std::size_t run(std::uint32_t slot, std::uint32_t rings);

  /// Returns these vertices and the ignored ones by their places, ring by ring, in no order within a ring. They are
  /// valid until the next `run`.
  [[nodiscard]] std::span<const std::uint32_t> reached() const { return queue_; }

  /// Returns these vertices, by their places in index order, ascending. They are valid until the next `run`.
  [[nodiscard]] std::span<const std::uint32_t> places();

  /// Returns the number of edges to one of them.
  [[nodiscard]] std::uint32_t edges_to(std::uint32_t place) const { return edges_to_[place]; }

  /// Returns them leaf by leaf. It takes much longer on a star, whose leaves have a vertex each.
  [[nodiscard]] std::span<const Piece> pieces();

  /// Gives numbers of edges as lengths.
  void select(LeafId leaf) override { first_ = index_->leaf_begin[leaf]; }
  [[nodiscard]] const PathLengths& at(unsigned lane) override {
    length_[0] = edges_to_[first_ + lane];
    return length_;
  }

 private:
  const IndexView* index_;
  KeptGraph* graph_;
  EpochArray<std::uint32_t> edges_to_;  // by place
  NumberSet found_;
  std::vector<std::uint32_t> queue_;
  std::vector<std::uint32_t> places_;  // made from `found_` when they are asked for
  std::vector<Piece> pieces_;          // likewise, from these
  std::vector<PerLane<QueryWord>> words_;
  std::size_t first_ = 0;  // of the selected leaf
  PathLengths length_{};
};

}  // namespace meshhood::inline v0_1
