// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "batch/row_search.h"
#include "exact/index_access.h"
#include "exact/joint/ring_packet.h"
#include "exact/query/vertex_rings.h"
#include "exact/search/vertex_bfs.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {
namespace {

/// More edges than a mesh has vertices are as good as any number of them.
std::uint32_t rings_of(double radius) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(radius, kMost));
}

/// The rings of a batch: those of a leaf are answered together, with distances one by one; on a graph unlike a surface,
/// vertex by vertex.
class RingRows final : public RowSearch {
 public:
  explicit RingRows(const Index& index)
      : index_(IndexAccess::view(index)),
        graph_(IndexAccess::share_graph(index)),
        packet_(index_, best_isa()),
        writer_(index_, best_isa()) {
    if (is_unlike_a_surface(index_)) by_vertex_.emplace(index_, *graph_);
  }

  [[nodiscard]] bool pays(std::span<const BatchItem> /*items*/, bool distances) const override {
    return writes_pieces(distances);
  }

  [[nodiscard]] bool run(std::span<const RowRun> runs) override {
    const std::span<const BatchItem> items = runs.front().items;
    rows_ = static_cast<unsigned>(items.size());
    if (by_vertex_) {
      counts_[0] = by_vertex_->run(items.front().position, rings_of(items.front().radius));
      return true;
    }
    queries_.clear();
    for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), rings_of(item.radius)});
    packet_.run(leaf_of(items.front().position), queries_);
    counts_ = packet_.counts();
    return true;
  }

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
             RowReceiver& receiver) override {
    if (writes_pieces(distances)) return write_pieces(writer_, items, answers, distances, receiver);
    const BatchMemory memory = receiver.memory(items.front().row, counts_[0]);
    std::size_t next = 0;
    for_each([&](std::size_t vertex, double edges) {
      memory.ids[next] = index_.id(vertex);
      if (distances) memory.distances[next] = edges;
      ++next;
    });
    return receiver.done(items.front().row);
  }

 private:
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
        if (reached[lane] != 0) f(index_.leaf_begin[leaves.begin] + lane, packet_.at(lane)[0]);
      }
    }
  }

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

}  // namespace

std::unique_ptr<RowSearch> make_ring_rows(const Index& index) { return std::make_unique<RingRows>(index); }

}  // namespace meshhood::inline v0_1
