// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/index.h"
#include "meshhood/search.h"

#include "batch/row_search.h"
#include "exact/bound_index.h"
#include "exact/index_access.h"
#include "exact/joint/ring_packet.h"
#include "exact/joint/row_writer.h"
#include "exact/query/vertex_rings.h"
#include "exact/weighted_graph.h"

namespace meshhood {

/// The rings of vertices of a leaf: together, or on a graph unlike a surface vertex by vertex.
class LeafRings {
 public:
  explicit LeafRings(const Index& index);

  /// Whether there is one query a run.
  [[nodiscard]] bool is_by_vertex() const { return by_vertex_.has_value(); }

  /// Finds the vertices that at most `radius` edges, rounded down, separate from each.
  void run(std::span<const BatchItem> items);

  // Of the last run, valid until the next:

  [[nodiscard]] const PerLane<std::uint64_t>& counts() const { return counts_; }
  [[nodiscard]] std::span<const Piece> pieces() { return by_vertex_ ? by_vertex_->pieces() : packet_.pieces(); }

  /// Of one query: calls `f(vertex, edges)` for the vertices of the answer, in index order, ascending.
  template <class F>
  void for_each(F&& f) {
    if (by_vertex_) {
      for (const std::uint32_t place : by_vertex_->places()) f(place, by_vertex_->edges_to(place));
      return;
    }
    for (const auto& [leaves, queries, reached] : packet_.pieces()) {
      packet_.select(leaves.begin);
      for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
        if (reached[lane] != 0) f(index_->leaf_begin[leaves.begin] + lane, packet_.at(lane)[0]);
      }
    }
  }

  /// Of one query.
  [[nodiscard]] PacketLengths& lengths() {
    return by_vertex_ ? static_cast<PacketLengths&>(*by_vertex_) : static_cast<PacketLengths&>(packet_);
  }

 private:
  const IndexView* index_;
  std::shared_ptr<KeptGraph> graph_;
  RingPacket packet_;
  std::optional<VertexRings> by_vertex_;
  std::vector<RingQuery> queries_;
  PerLane<std::uint64_t> counts_{};
};

/// The rings of one vertex, in index order; distances are numbers of edges. A `NeighborhoodSearcher`.
class RingSearcher {
 public:
  explicit RingSearcher(const Index& index) : index_(index), rings_(index) {}

  [[nodiscard]] std::size_t vertex_count() const { return index_->vertex_count(); }
  [[nodiscard]] std::span<const VertexId> permutation() const;
  [[nodiscard]] std::vector<VertexId> neighborhood(VertexId v, double radius);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out);
  void neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances);
  [[nodiscard]] std::size_t count(VertexId v, double radius);
  [[nodiscard]] std::span<const VertexRange> ranges(VertexId v, double radius);

 private:
  void run(VertexId v, double radius);

  BoundIndex index_;
  LeafRings rings_;
  std::vector<VertexRange> ranges_;  // of the last call of that name
};

/// The same for the rows of a batch: those of a leaf are answered together, with distances one by one.
class RingRows final : public RowSearch {
 public:
  explicit RingRows(const Index& index)
      : index_(IndexAccess::view(index)), rings_(index), writer_(IndexAccess::view(index), best_isa()) {}

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool distances) const override {
    return !distances && !rings_.is_by_vertex();
  }
  [[nodiscard]] bool run(std::span<const RowRun> runs) override;
  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return rings_.counts(); }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(rows_); }
  [[nodiscard]] std::span<const Piece> pieces() override { return rings_.pieces(); }
  [[nodiscard]] PacketLengths* lengths() override { return &rings_.lengths(); }
  [[nodiscard]] bool writes_pieces(bool distances) const override { return !distances && !rings_.is_by_vertex(); }
  bool write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
             RowReceiver& receiver) override;

 private:
  const IndexView& index_;
  LeafRings rings_;
  RowWriter writer_;
  unsigned rows_ = 0;  // of the last run
};

}  // namespace meshhood
