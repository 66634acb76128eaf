// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/joint/path_packet.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {
namespace {

/// Finds the neighborhoods of a batch along the edges, as a `Searcher` finds them one by one.
class PathRows final : public RowSearch {
 public:
  explicit PathRows(const Index& index)
      : view_(IndexAccess::view(index)), graph_(IndexAccess::share_graph(index)), packet_(view_, *graph_, best_isa()) {}

  [[nodiscard]] bool pays(std::span<const BatchItem> items, bool /*distances*/) const override {
    constexpr std::size_t kFewestTogether = 4;  // fewer rows of a leaf are answered faster one by one
    return items.size() >= kFewestTogether;
  }

  [[nodiscard]] bool run(std::span<const RowRun> runs) override {
    const auto& [items, is_joint] = runs.front();
    queries_.clear();
    for (const auto& [row, vertex, position, radius] : items) {
      queries_.push_back({view_.place_at(position), radius});
    }
    if (is_joint) return packet_.run(queries_);
    packet_.run_single(queries_.front());
    return true;
  }

  [[nodiscard]] const PerLane<std::uint64_t>& counts() override { return counts_ = packet_.counts(); }
  [[nodiscard]] QueryWord queries() const override { return first_lanes(static_cast<unsigned>(queries_.size())); }
  [[nodiscard]] std::span<const Piece> pieces(bool /*in_order*/) override { return packet_.pieces(); }
  [[nodiscard]] PacketLengths* lengths() override { return &packet_; }
  [[nodiscard]] bool writes_pieces(bool /*distances*/) const override { return false; }  // rows ascend by length

  bool write(std::span<const BatchItem> items, bool distances, RowReceiver& receiver) override {
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::span<const Path> paths = packet_.paths_in_order(i);
      const BatchMemory memory = receiver.memory(items[i].row, paths.size());
      for (std::size_t k = 0; k < paths.size(); ++k) memory.ids[k] = view_.id(paths[k].end);
      if (distances) std::ranges::transform(paths, memory.distances.begin(), &Path::length);
      if (!receiver.done(items[i].row)) return false;
    }
    return true;
  }

 private:
  const IndexView& view_;
  std::shared_ptr<KeptGraph> graph_;
  PathPacket packet_;
  // The state of the last run.
  std::vector<PathQuery> queries_;
  PerLane<std::uint64_t> counts_{};
};

}  // namespace

std::unique_ptr<RowSearch> make_path_rows(const Index& index) { return std::make_unique<PathRows>(index); }

}  // namespace meshhood::inline v0_1
