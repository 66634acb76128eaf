// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/search.h"

#include "batch/searcher_factory.h"
#include "batch/single_packet.h"
#include "exact/joint/joint_search.h"
#include "exact/joint/packet_answer.h"
#include "exact/joint/row_writer.h"
#include "exact/layout.h"

namespace meshhood {

/// The exact neighborhoods of a batch. Rows of one leaf are answered together if there are enough of them, and one by
/// one otherwise. The index must outlive the worker.
class JointWorker final : public BatchWorker {
 public:
  /// The positions of a group: rows that lie between two multiples of it should come in one chunk.
  static constexpr std::uint32_t kGroupPositions = kFanOut * kLeafCapacity;

  explicit JointWorker(const Index& index, Isa isa = best_isa());

  void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) override;
  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
            KeptPackets::Reader* kept) override;

  /// Passes on the packets of a chunk. `sink` returns false to drop the rest.
  void visit(std::span<const BatchItem> chunk, const std::function<bool(const PacketAnswer&)>& sink);

 private:
  /// Consecutive rows of one leaf, to be answered together, or one row to be answered alone.
  struct Run {
    LeafId leaf;
    std::span<const BatchItem> items;
    bool is_joint;
  };

  static LeafId group_of(const Run& run) { return run.leaf / kFanOut; }
  template <class F>
  void for_each_run(std::span<const BatchItem> chunk, F&& f);
  void split(std::span<const BatchItem> chunk);
  std::span<const Piece> answer(const Run& run);
  const PerLane<std::uint64_t>& counts_of(const Run& run);
  bool write(std::span<const BatchItem> items, const PerLane<std::uint64_t>& counts, bool distances,
             RowReceiver& receiver);
  void search_together(const Run& run);
  void begin_group(std::span<const Run> runs);
  [[nodiscard]] bool pays(LeafId leaf, std::size_t size, double radius) const;
  [[nodiscard]] const JointRadius& prepared(double radius);
  const VertexSet& search_single(const BatchItem& item);
  [[nodiscard]] Point position_of(const BatchItem& item) const;
  Searcher& searcher();

  const Index& index_;
  const IndexView& view_;
  Isa isa_;
  std::optional<Searcher> searcher_;
  std::optional<JointSearch> joint_;
  JointRadius radius_;  // of the last row, because most batches have one radius
  std::vector<Run> runs_;
  std::vector<LeafId> leaves_;
  std::vector<JointQuery> queries_;
  bool unlike_a_surface_;
  RowWriter writer_;
  PacketLists lists_;
  SinglePacket single_packet_;
};

}  // namespace meshhood
