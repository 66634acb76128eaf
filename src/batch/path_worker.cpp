// SPDX-License-Identifier: MIT
#include "batch/path_worker.h"

#include <algorithm>

#include "exact/index_access.h"

namespace meshhood {
namespace {

// Fewer rows of a leaf are answered faster one by one.
constexpr std::size_t kFewestTogether = 4;

}  // namespace

PathWorker::PathWorker(const Index& index, std::shared_ptr<const FilterCopy> filter, Isa isa)
    : view_(IndexAccess::view(index)),
      filter_(std::move(filter)),
      walls_(view_, filter_ ? filter_->view().walls : VertexMask()),
      ignored_(view_, filter_ ? filter_->view().ignored : VertexMask()),
      graph_(IndexAccess::share_graph(index)),
      packet_(view_, *graph_, isa, walls_, ignored_) {}

void PathWorker::count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* /*kept*/) {
  visit(chunk, [&](std::span<const BatchItem> rows, PathPacket& packet) {
    const PerLane<std::uint64_t> counts = packet.counts();
    return sink(rows, std::span(counts).first(rows.size()));
  });
}

void PathWorker::find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                      KeptPackets::Reader* /*kept*/) {
  visit(chunk, [&](std::span<const BatchItem> rows, PathPacket& packet) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::span<const Path> paths = packet.paths_in_order(i);
      const BatchMemory memory = receiver.memory(rows[i].row, paths.size());
      for (std::size_t k = 0; k < paths.size(); ++k) memory.ids[k] = view_.id(paths[k].end);
      if (distances) std::ranges::transform(paths, memory.distances.begin(), &Path::length);
      if (!receiver.done(rows[i].row)) return false;
    }
    return true;
  });
}

void PathWorker::visit(std::span<const BatchItem> chunk,
                       const std::function<bool(std::span<const BatchItem> rows, PathPacket& packet)>& sink) {
  while (!chunk.empty()) {
    const LeafId leaf = leaf_of(chunk.front().position);
    const auto end = std::ranges::find_if(chunk.first(std::min(chunk.size(), kPacketCapacity)),
                                          [&](const BatchItem& item) { return leaf_of(item.position) != leaf; });
    const std::span<const BatchItem> rows(chunk.begin(), end);
    chunk = chunk.subspan(rows.size());
    if (run(rows)) {
      if (!sink(rows, packet_)) return;
      continue;
    }
    for (const BatchItem& item : rows) {
      packet_.run_single(query_of(item));
      if (!sink({&item, 1}, packet_)) return;
    }
  }
}

/// Answers the rows together. Returns false if it is faster to answer them one by one.
bool PathWorker::run(std::span<const BatchItem> rows) {
  if (rows.size() < kFewestTogether) return false;
  queries_.clear();
  for (const BatchItem& item : rows) queries_.push_back(query_of(item));
  return packet_.run(queries_);
}

PathQuery PathWorker::query_of(const BatchItem& item) const {
  return {view_.leaf_begin[leaf_of(item.position)] + lane_of(item.position), item.radius};
}

}  // namespace meshhood
