// SPDX-License-Identifier: MIT
#include "exact/query/vertex_rings.h"

namespace meshhood::inline v0_1 {

std::size_t VertexRings::run(std::uint32_t slot, std::uint32_t rings) {
  const Adjacency& edges = *graph_->of(*index_).edges;
  edges_to_.forget();
  found_.clear();
  places_.clear();
  pieces_.clear();
  queue_.clear();
  const auto reach = [&](std::uint32_t place, std::uint32_t count) {
    if (edges_to_.is_known(place)) return;
    edges_to_.set(place, count);
    if (!index_->is_wall_at(place)) queue_.push_back(place);
  };
  reach(index_->place_at(slot), 0);
  std::size_t count = 0;
  // NOLINTNEXTLINE(modernize-loop-convert): the queue grows meanwhile
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::uint32_t place = queue_[head];
    if (!index_->is_ignored_at(place)) {
      found_.insert(place);
      ++count;
    }
    const std::uint32_t next = edges_to_[place] + 1;
    if (next > rings || next == 0) continue;  // all that follow are as far
    for (std::size_t i = edges.offsets[place]; i < edges.offsets[place + std::size_t{1}]; ++i) {
      reach(edges.neighbors[i], next);
    }
  }
  return count;
}

std::vector<std::vector<std::uint32_t>> VertexRings::rings() {
  std::vector<std::vector<std::uint32_t>> rings(queue_.empty() ? 0 : edges_to(queue_.back()) + 1);
  for (const std::uint32_t place : places()) rings[edges_to(place)].push_back(place);
  return rings;
}

std::span<const std::uint32_t> VertexRings::places() {
  found_.take_all([&](std::size_t place) { places_.push_back(static_cast<std::uint32_t>(place)); });
  return places_;
}

std::span<const Piece> VertexRings::pieces() {
  if (!pieces_.empty()) return pieces_;
  words_.clear();
  for (const std::uint32_t place : places()) {
    const std::uint32_t slot = index_->slot_at(place);
    const LeafId leaf = leaf_of(slot);
    if (pieces_.empty() || pieces_.back().leaves.begin != leaf) {
      pieces_.push_back({{leaf, leaf + 1}, 0, nullptr});
      words_.push_back({});
    }
    words_.back()[lane_of(slot)] = 1;
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) pieces_[i].reached = words_[i].data();
  return pieces_;
}

}  // namespace meshhood::inline v0_1
