// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "meshhood/batch.h"
#include "meshhood/search.h"

#include "batch/kept_packets.h"

namespace meshhood {

/// One row of a batch.
struct BatchItem {
  std::size_t row;
  VertexId vertex;
  std::uint32_t position;  // `SearcherFactory::position`
  double radius;
};

/// Receives the sizes of some rows of a chunk. Returns false to drop the rest of the chunk.
using SizeSink = std::function<bool(std::span<const BatchItem> rows, std::span<const std::uint64_t> sizes)>;

/// Receives rows in memory that it provides, so that ids are written once.
class RowReceiver {
 public:
  RowReceiver() = default;
  RowReceiver(const RowReceiver&) = delete;
  RowReceiver& operator=(const RowReceiver&) = delete;
  virtual ~RowReceiver() = default;

  /// Memory for the ids of a row of `size` vertices, and for its distances if they are requested.
  virtual BatchMemory memory(std::size_t row, std::size_t size) = 0;

  /// The row has been written there. Returns false to drop the rest of the chunk.
  virtual bool done(std::size_t row) = 0;
};

/// Computes chunks of rows, on one thread. The vertices of a chunk ascend in index order. The result of a chunk must
/// not depend on earlier chunks, because which chunks a thread gets differs from run to run.
class BatchWorker {
 public:
  BatchWorker() = default;
  BatchWorker(const BatchWorker&) = delete;
  BatchWorker& operator=(const BatchWorker&) = delete;
  virtual ~BatchWorker() = default;

  /// `kept` is null, or receives what spares `find` a second search. A worker whose `find` always searches adds
  /// nothing.
  virtual void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept) = 0;

  /// `kept` is null, or reads what `count` kept of the same chunk, none of whose rows was dropped.
  virtual void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver,
                    KeptPackets::Reader* kept) = 0;
};

/// What a `SearchMethod` refers to. Any thread may call the functions.
struct SearcherFactory {
  std::size_t vertex_count;

  /// Makes a searcher, for one thread.
  std::function<AnySearcher()> make_searcher;

  /// Ascends with the order in which vertices are best searched: near vertices have near positions.
  std::function<std::uint32_t(VertexId v)> position;

  /// The index whose slots the positions are; null if they are others. Lives as long as the functions.
  const Index* of_slots = nullptr;

  /// Counting takes much less time than listing. If not, rows to be kept are searched once, and copied.
  bool is_count_cheap = false;

  /// Rows that lie between two multiples of this many positions are computed together.
  std::uint32_t positions_together = 1;

  /// The same method with answers that a filter restricts; empty if it has no filters, or already one. Copies the
  /// masks. Throws Error{InvalidOption} unless each is empty or has a value for each vertex.
  std::function<std::shared_ptr<const SearcherFactory>(const Filter& filter, unsigned threads)> with_filter = {};

  /// Makes a worker that answers rows together; empty if rows are answered one by one, by a searcher.
  std::function<std::unique_ptr<BatchWorker>()> make_joint_worker = {};

  /// The worker of a thread.
  [[nodiscard]] std::unique_ptr<BatchWorker> make_worker() const;

  /// As `with_filter`; refuses it where that is empty.
  [[nodiscard]] std::shared_ptr<const SearcherFactory> restricted(const Filter& filter, unsigned threads) const;
};

}  // namespace meshhood
