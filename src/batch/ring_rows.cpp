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

/// Calls `f(leaf, lane, length)` for the vertices of an answer to one query, ascending.
template <class F>
void for_each_length(std::span<const Piece> pieces, PacketLengths& lengths, F&& f) {
  for (const auto& [leaves, queries, reached] : pieces) {
    lengths.select(leaves.begin);
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      if (reached[lane] != 0) f(leaves.begin, lane, lengths.at(lane)[0]);
    }
  }
}

}  // namespace

LeafRings::LeafRings(const Index& index)
    : graph_(IndexAccess::share_graph(index)), packet_(IndexAccess::view(index), best_isa()) {
  if (is_unlike_a_surface(IndexAccess::view(index))) by_vertex_.emplace(IndexAccess::view(index), *graph_);
}

void LeafRings::run(std::span<const BatchItem> items) {
  if (by_vertex_) {
    counts_[0] = by_vertex_->run(items.front().position, rings_of(items.front().radius));
    return;
  }
  queries_.clear();
  for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), rings_of(item.radius)});
  packet_.run(leaf_of(items.front().position), queries_);
  counts_ = packet_.counts();
}

std::span<const VertexId> RingSearcher::permutation() const {
  const std::span<const VertexId> padded = index_->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void RingSearcher::run(VertexId v, double radius) {
  index_.check_current();
  check_query(v, vertex_count(), radius);
  rings_.run(std::array{BatchItem{0, v, index_->slot[v], radius}});
}

/// Calls `f(vertex, edges)` for the vertices of the answer, by their numbers in index order, ascending.
template <class F>
void RingSearcher::search(VertexId v, double radius, F&& f) {
  run(v, radius);
  for_each_length(rings_.pieces(), rings_.lengths(),
                  [&](LeafId leaf, unsigned lane, double edges) { f(index_->leaf_begin[leaf] + lane, edges); });
}

std::vector<VertexId> RingSearcher::neighborhood(VertexId v, double radius) {
  std::vector<VertexId> out;
  neighborhood(v, radius, out);
  return out;
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  std::vector<VertexId> ids;
  search(v, radius, [&](std::size_t vertex, double) { ids.push_back(index_->id(vertex)); });
  out = std::move(ids);
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  std::vector<VertexId> ids;
  std::vector<double> edges_to;
  search(v, radius, [&](std::size_t vertex, double edges) {
    ids.push_back(index_->id(vertex));
    edges_to.push_back(edges);
  });
  out = std::move(ids);
  distances = std::move(edges_to);
}

std::size_t RingSearcher::count(VertexId v, double radius) {
  run(v, radius);
  return rings_.counts()[0];
}

std::span<const VertexRange> RingSearcher::ranges(VertexId v, double radius) {
  ranges_.clear();
  search(v, radius, [&](std::size_t vertex, double) { append_to(ranges_, static_cast<VertexId>(vertex)); });
  return ranges_;
}

bool RingRows::run(std::span<const RowRun> runs) {
  rows_ = static_cast<unsigned>(runs.front().items.size());
  rings_.run(runs.front().items);
  return true;
}

bool RingRows::write(std::span<const BatchItem> items, const RowAnswers& answers, bool distances,
                     RowReceiver& receiver) {
  const RowAnswers own{rings_.pieces(), rings_.counts()};
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
  for_each_length(rings_.pieces(), rings_.lengths(), [&](LeafId, unsigned, double edges) { *next++ = edges; });
}

}  // namespace meshhood
