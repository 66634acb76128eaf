// SPDX-License-Identifier: MIT
#include "batch/ring_rows.h"

#include <algorithm>
#include <limits>

#include "exact/search/vertex_bfs.h"

namespace meshhood {
namespace {

/// More edges than a mesh has vertices are as good as any number of them.
std::uint32_t rings_of(double radius) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(radius, kMost));
}

}  // namespace

RingRows::RingRows(const Index& index)
    : index_(IndexAccess::view(index)),
      graph_(IndexAccess::share_graph(index)),
      packet_(index_, best_isa()),
      writer_(index_, best_isa()) {
  if (is_unlike_a_surface(index_)) by_vertex_.emplace(index_, *graph_);
}

bool RingRows::run(std::span<const RowRun> runs) {
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

template <class F>
void RingRows::for_each(F&& f) {
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

bool RingRows::write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
                     RowReceiver& receiver) {
  if (writes_pieces(distances)) {
    writer_.begin(answers.pieces);
    for (unsigned i = 0; i < items.size(); ++i) {
      writer_.write_ids(i, receiver.memory(items[i].row, answers.counts[i]).ids);
      if (!receiver.done(items[i].row)) return false;
    }
    return true;
  }
  const BatchMemory memory = receiver.memory(items.front().row, counts_[0]);
  std::size_t next = 0;
  for_each([&](std::size_t vertex, double edges) {
    memory.ids[next] = index_.id(vertex);
    if (distances) memory.distances[next] = edges;
    ++next;
  });
  return receiver.done(items.front().row);
}

}  // namespace meshhood
