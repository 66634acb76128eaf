// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "batch/filter_copy.h"
#include "batch/searcher_factory.h"
#include "exact/joint/path_packet.h"
#include "exact/layout.h"
#include "exact/query/lane_filter.h"
#include "exact/weighted_graph.h"

namespace meshhood {

/// The neighborhoods of a batch along the edges, as `EdgeSearcher` finds them one by one. Rows of one leaf are answered
/// together if there are enough of them. The index must outlive the worker.
class PathWorker final : public BatchWorker {
 public:
  /// `filter`: null if there is none.
  PathWorker(const Index& index, std::shared_ptr<const FilterCopy> filter, Isa isa = best_isa());

  void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) override;
  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
            KeptPackets::Reader* kept) override;

  /// Passes on a chunk packet by packet: query `i` of a packet is `rows[i]`. `sink` returns false to drop the rest.
  void visit(std::span<const BatchItem> chunk,
             const std::function<bool(std::span<const BatchItem> rows, PathPacket& packet)>& sink);

 private:
  [[nodiscard]] bool run(std::span<const BatchItem> rows);
  [[nodiscard]] PathQuery query_of(const BatchItem& item) const;

  const IndexView& view_;
  std::shared_ptr<const FilterCopy> filter_;
  LaneFilter walls_;
  LaneFilter ignored_;
  std::shared_ptr<KeptGraph> graph_;
  PathPacket packet_;
  std::vector<PathQuery> queries_;
};

}  // namespace meshhood
