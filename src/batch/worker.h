// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "batch/kept_packets.h"
#include "batch/row_search.h"
#include "exact/joint/packet_answer.h"

namespace meshhood::inline v0_1 {

/// Receives the sizes of some rows of a chunk. Returns false to drop the rest of the chunk.
using SizeSink = std::function<bool(std::span<const BatchItem> rows, std::span<const std::uint64_t> sizes)>;

/// Computes chunks of rows by a search, on one thread. The vertices of a chunk ascend in index order. The result of a
/// chunk does not depend on earlier chunks, because which chunks a thread gets differs from run to run.
class BatchWorker {
 public:
  explicit BatchWorker(std::unique_ptr<RowSearch> search) : search_(std::move(search)) {}

  /// `kept` is null, or receives what spares `find` a second search.
  void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept);

  /// `kept` is null, or reads what `count` kept of the same chunk, none of whose rows was dropped.
  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver, KeptPackets::Reader* kept);

  /// Passes on the packets of a chunk, with the lengths of the metric if they are wanted. `sink` returns false to drop
  /// the rest.
  void visit(std::span<const BatchItem> chunk, bool lengths, const std::function<bool(const PacketAnswer&)>& sink);

 private:
  /// Answers a chunk run by run, and calls `f(items)` after each until it returns false.
  template <class F>
  void for_each_answer(std::span<const BatchItem> chunk, bool distances, F&& f) {
    split(chunk, distances);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!answer(i, f)) return;
    }
  }

  /// Cuts a chunk into `runs_`.
  void split(std::span<const BatchItem> chunk, bool distances);

  /// Answers run number `i`, together or row by row.
  template <class F>
  bool answer(std::size_t i, F&& f) {
    const std::span<const BatchItem> items = runs_[i].items;
    if (search_->run(std::span(runs_).subspan(i))) return f(items);
    for (const BatchItem& item : items) {
      const RowRun alone{{&item, 1}, false};
      static_cast<void>(search_->run({&alone, 1}));
      if (!f(alone.items)) return false;
    }
    return true;
  }

  std::unique_ptr<RowSearch> search_;
  std::vector<RowRun> runs_;
  // The rows of a packet, an array for each property:
  std::vector<std::size_t> rows_;
  std::vector<VertexId> vertices_;
  std::vector<double> radii_;
};

}  // namespace meshhood::inline v0_1
