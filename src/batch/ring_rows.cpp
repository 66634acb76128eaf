// SPDX-License-Identifier: MIT
#include "batch/ring_rows.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/ranges.h"
#include "exact/index_access.h"
#include "exact/search/vertex_bfs.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

/// More edges than a mesh has vertices are as good as any number of them.
std::uint32_t rings_of(double radius) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(radius, kMost));
}

}  // namespace

RingSearcher::RingSearcher(const Index& index)
    : index_(index), graph_(IndexAccess::share_graph(index)), packet_(*index_, best_isa()) {
  if (is_unlike_a_surface(*index_)) by_vertex_.emplace(*index_, *graph_);
}

std::span<const VertexId> RingSearcher::permutation() const {
  const std::span<const VertexId> padded = index_->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

/// Returns how many vertices there are.
std::size_t RingSearcher::run(VertexId v, double radius) {
  index_.check_current();
  check_query(v, vertex_count(), radius);
  const std::uint32_t slot = index_->slot[v];
  if (by_vertex_) return by_vertex_->run(slot, rings_of(radius));
  packet_.run(leaf_of(slot), std::array{RingQuery{lane_of(slot), rings_of(radius)}});
  return packet_.counts()[0];
}

/// Calls `f(vertex, edges)` for the vertices of the answer, by their numbers in index order, ascending.
template <class F>
void RingSearcher::search(VertexId v, double radius, F&& f) {
  run(v, radius);
  if (by_vertex_) return by_vertex_->take(f);
  for (const auto& [leaves, queries, reached] : packet_.pieces()) {
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      if (reached[lane] != 0) f(index_->leaf_begin[leaves.begin] + lane, packet_.edges_to(leaves.begin, lane));
    }
  }
}

std::vector<VertexId> RingSearcher::neighborhood(VertexId v, double radius) {
  std::vector<VertexId> out;
  neighborhood(v, radius, out);
  return out;
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  std::vector<VertexId> ids;
  search(v, radius, [&](std::size_t vertex, std::uint32_t) { ids.push_back(index_->id(vertex)); });
  out = std::move(ids);
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  std::vector<VertexId> ids;
  std::vector<double> edges_to;
  search(v, radius, [&](std::size_t vertex, std::uint32_t edges) {
    ids.push_back(index_->id(vertex));
    edges_to.push_back(edges);
  });
  out = std::move(ids);
  distances = std::move(edges_to);
}

std::size_t RingSearcher::count(VertexId v, double radius) { return run(v, radius); }

std::span<const VertexRange> RingSearcher::ranges(VertexId v, double radius) {
  ranges_.clear();
  search(v, radius, [&](std::size_t vertex, std::uint32_t) { append_to(ranges_, static_cast<VertexId>(vertex)); });
  return ranges_;
}

RingRows::RingRows(const Index& index)
    : packet_(IndexAccess::view(index), best_isa()), writer_(IndexAccess::view(index), best_isa()) {}

bool RingRows::run(std::span<const RowRun> runs) {
  const std::span<const BatchItem> items = runs.front().items;
  queries_.clear();
  for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), rings_of(item.radius)});
  packet_.run(leaf_of(items.front().position), queries_);
  counts_ = packet_.counts();
  return true;
}

bool RingRows::write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
                     RowReceiver& receiver) {
  const RowAnswers own{packet_.pieces(), counts_};
  const auto& [pieces, counts] = distances ? own : answers;
  writer_.begin(pieces);
  for (unsigned i = 0; i < items.size(); ++i) {
    const BatchMemory memory = receiver.memory(items[i].row, counts[i]);
    writer_.write_ids(i, memory.ids);
    if (distances) write_distances(memory.distances);
    if (!receiver.done(items[i].row)) return false;
  }
  return true;
}

/// Of a run with one row.
void RingRows::write_distances(std::span<double> distances) {
  double* next = distances.data();
  for (const auto& [leaves, queries, reached] : packet_.pieces()) {
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      if (reached[lane] != 0) *next++ = packet_.edges_to(leaves.begin, lane);
    }
  }
}

}  // namespace meshhood
