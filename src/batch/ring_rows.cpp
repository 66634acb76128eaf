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

LeafRings::LeafRings(const Index& index)
    : index_(&IndexAccess::view(index)),
      graph_(IndexAccess::share_graph(index)),
      packet_(IndexAccess::view(index), best_isa()) {
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

std::vector<VertexId> RingSearcher::neighborhood(VertexId v, double radius) {
  std::vector<VertexId> out;
  neighborhood(v, radius, out);
  return out;
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  std::vector<VertexId> ids;
  run(v, radius);
  rings_.for_each([&](std::size_t vertex, double) { ids.push_back(index_->id(vertex)); });
  out = std::move(ids);
}

void RingSearcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  std::vector<VertexId> ids;
  std::vector<double> edges_to;
  run(v, radius);
  rings_.for_each([&](std::size_t vertex, double edges) {
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
  run(v, radius);
  rings_.for_each([&](std::size_t vertex, double) { append_to(ranges_, static_cast<VertexId>(vertex)); });
  return ranges_;
}

bool RingRows::run(std::span<const RowRun> runs) {
  rows_ = static_cast<unsigned>(runs.front().items.size());
  rings_.run(runs.front().items);
  return true;
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
  const BatchMemory memory = receiver.memory(items.front().row, rings_.counts()[0]);
  std::size_t next = 0;
  rings_.for_each([&](std::size_t vertex, double edges) {
    memory.ids[next] = index_.id(vertex);
    if (distances) memory.distances[next] = edges;
    ++next;
  });
  return receiver.done(items.front().row);
}

}  // namespace meshhood
