// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/index.h"

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/joint/ring_packet.h"
#include "exact/joint/row_writer.h"
#include "exact/query/vertex_rings.h"
#include "exact/weighted_graph.h"

namespace meshhood {

/// The rings of a batch: those of a leaf are answered together, with distances one by one; on a graph unlike a surface,
/// vertex by vertex. The index must outlive it.
class RingRows final : public RowSearch {
 public:
  explicit RingRows(const Index& index);

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool distances) const override {
    return writes_pieces(distances);
  }
  [[nodiscard]] bool run(std::span<const RowRun> runs) override;
  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return counts_; }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(rows_); }
  [[nodiscard]] std::span<const Piece> pieces() override {
    return by_vertex_ ? by_vertex_->pieces() : packet_.pieces();
  }
  [[nodiscard]] PacketLengths* lengths() override {
    return by_vertex_ ? static_cast<PacketLengths*>(&*by_vertex_) : &packet_;
  }
  [[nodiscard]] bool writes_pieces(bool distances) const override { return !distances && !by_vertex_; }
  bool write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
             RowReceiver& receiver) override;

 private:
  /// Of one query: calls `f(vertex, edges)` for the vertices of the answer, in index order, ascending.
  template <class F>
  void for_each(F&& f);

  const IndexView& index_;
  std::shared_ptr<KeptGraph> graph_;
  RingPacket packet_;
  std::optional<VertexRings> by_vertex_;
  RowWriter writer_;
  // Of the last run:
  unsigned rows_ = 0;
  std::vector<RingQuery> queries_;
  PerLane<std::uint64_t> counts_{};
};

}  // namespace meshhood
