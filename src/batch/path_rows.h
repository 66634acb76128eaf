// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "batch/row_search.h"
#include "exact/joint/path_packet.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"

namespace meshhood {

/// The neighborhoods of a batch along the edges, as a `Searcher` finds them one by one. The index must outlive it.
class PathRows final : public RowSearch {
 public:
  explicit PathRows(const Index& index, Isa isa = best_isa());

  [[nodiscard]] bool pays(std::span<const BatchItem> items, bool distances) const override;
  [[nodiscard]] bool run(std::span<const RowRun> runs) override;
  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return counts_ = packet_.counts(); }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(static_cast<unsigned>(queries_.size())); }
  [[nodiscard]] std::span<const Piece> pieces() override { return packet_.pieces(); }
  [[nodiscard]] PacketLengths* lengths() override { return &packet_; }
  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return false; }  // rows ascend by length
  bool write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
             RowReceiver& receiver) override;

 private:
  const IndexView& view_;
  std::shared_ptr<KeptGraph> graph_;
  PathPacket packet_;
  // Of the last run:
  std::vector<PathQuery> queries_;
  PerLane<std::uint64_t> counts_{};
};

}  // namespace meshhood
