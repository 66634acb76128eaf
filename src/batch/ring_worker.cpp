// SPDX-License-Identifier: MIT
#include "batch/ring_worker.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/ranges.h"
#include "exact/index_access.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

/// More edges than a mesh has vertices are as good as any number of them.
std::uint32_t rings_of(double radius) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(radius, kMost));
}

}  // namespace

RingSearcher::RingSearcher(const Index& index) : index_(index), packet_(*index_, best_isa()) {}

std::span<const VertexId> RingSearcher::permutation() const {
  const std::span<const VertexId> padded = index_->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void RingSearcher::run(VertexId v, double radius) {
  index_.check_current();
  check_query(v, vertex_count(), radius);
  const std::uint32_t slot = index_->slot[v];
  packet_.run(leaf_of(slot), std::array{RingQuery{lane_of(slot), rings_of(radius)}});
}

/// Calls `f(vertex, edges)` for the vertices of the answer, by their numbers in index order, ascending.
template <class F>
void RingSearcher::search(VertexId v, double radius, F&& f) {
  run(v, radius);
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

std::size_t RingSearcher::count(VertexId v, double radius) {
  run(v, radius);
  return packet_.counts()[0];
}

std::span<const VertexRange> RingSearcher::ranges(VertexId v, double radius) {
  ranges_.clear();
  search(v, radius, [&](std::size_t vertex, std::uint32_t) { append_to(ranges_, static_cast<VertexId>(vertex)); });
  return ranges_;
}

RingWorker::RingWorker(const Index& index)
    : searcher_(index), packet_(IndexAccess::view(index), best_isa()), writer_(IndexAccess::view(index), best_isa()) {}

/// The first rows of a chunk, those of a leaf.
std::span<const BatchItem> RingWorker::first_packet(std::span<const BatchItem> chunk) {
  const LeafId leaf = leaf_of(chunk.front().position);
  const auto most = chunk.first(std::min(chunk.size(), kPacketCapacity));
  return {most.begin(), std::ranges::find_if(most, [&](const BatchItem& i) { return leaf_of(i.position) != leaf; })};
}

/// Calls `f(items)` for the packets of a chunk, until it returns false.
template <class F>
void RingWorker::for_each_packet(std::span<const BatchItem> chunk, F&& f) {
  while (!chunk.empty()) {
    const std::span<const BatchItem> items = first_packet(chunk);
    if (!f(items)) return;
    chunk = chunk.subspan(items.size());
  }
}

/// Finds the rings of the rows of a packet, and returns their sizes.
const PerLane<std::uint64_t>& RingWorker::search(std::span<const BatchItem> items) {
  queries_.clear();
  for (const BatchItem& item : items) queries_.push_back({lane_of(item.position), rings_of(item.radius)});
  packet_.run(leaf_of(items.front().position), queries_);
  return counts_ = packet_.counts();
}

bool RingWorker::write(std::span<const BatchItem> items, const PerLane<std::uint64_t>& counts, RowReceiver& receiver) {
  for (unsigned i = 0; i < items.size(); ++i) {
    writer_.write_ids(i, receiver.memory(items[i].row, counts[i]).ids);
    if (!receiver.done(items[i].row)) return false;
  }
  return true;
}

void RingWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) {
  for_each_packet(chunk, [&](std::span<const BatchItem> items) {
    const auto counts = std::span(search(items)).first(items.size());
    if (kept != nullptr) kept->add(packet_.pieces(), counts);
    return sink(items, counts);
  });
}

void RingWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                      KeptPackets::Reader* kept) {
  if (distances) return find_with_distances(chunk, receiver);
  for_each_packet(chunk, [&](std::span<const BatchItem> items) {
    const bool is_kept = kept != nullptr && kept->next();
    const PerLane<std::uint64_t>& counts = is_kept ? kept->counts() : search(items);
    writer_.begin(is_kept ? kept->pieces() : packet_.pieces());
    return write(items, counts, receiver);
  });
}

void RingWorker::find_with_distances(std::span<const BatchItem> chunk, RowReceiver& receiver) {
  for (const BatchItem& item : chunk) {
    searcher_.neighborhood(item.vertex, item.radius, ids_, distances_);
    const BatchMemory memory = receiver.memory(item.row, ids_.size());
    std::copy(ids_.begin(), ids_.end(), memory.ids.begin());
    std::copy(distances_.begin(), distances_.end(), memory.distances.begin());
    if (!receiver.done(item.row)) return;
  }
}

}  // namespace meshhood
