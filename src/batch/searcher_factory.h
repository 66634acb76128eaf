// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/searcher.h"

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

  virtual void count(std::span<const BatchItem> chunk, const SizeSink& sink) = 0;

  virtual void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver) = 0;
};

/// How a batch uses a method to be fast.
struct MethodTraits {
  /// Counting takes much less time than listing. If not, rows to be kept are searched once, and copied.
  bool is_count_cheap;

  /// Rows that lie between two multiples of this many positions are computed together.
  std::uint32_t positions_together = 1;
};

/// Makes the workers of a batch, one per thread. Any thread may call it.
class SearcherFactory {
 public:
  SearcherFactory() = default;
  SearcherFactory(const SearcherFactory&) = delete;
  SearcherFactory& operator=(const SearcherFactory&) = delete;
  virtual ~SearcherFactory() = default;

  [[nodiscard]] virtual std::size_t vertex_count() const = 0;

  /// Ascends with the order in which vertices are best searched: near vertices have near positions.
  [[nodiscard]] virtual std::uint32_t position(VertexId v) const = 0;

  [[nodiscard]] virtual MethodTraits traits() const = 0;

  [[nodiscard]] virtual std::unique_ptr<BatchWorker> make_worker() const = 0;
};

/// The worker of any searcher. `Begin` is called with the searcher before each chunk.
template <NeighborhoodSearcher S, std::invocable<S&> Begin>
class SearcherWorker final : public BatchWorker {
 public:
  SearcherWorker(S searcher, Begin begin) : searcher_(std::move(searcher)), begin_(std::move(begin)) {}

  void count(std::span<const BatchItem> chunk, const SizeSink& sink) override {
    begin_(searcher_);
    for (const BatchItem& item : chunk) {
      const std::uint64_t size = searcher_.count(item.vertex, item.radius);
      if (!sink({&item, 1}, {&size, 1})) return;
    }
  }

  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver) override {
    begin_(searcher_);
    for (const BatchItem& item : chunk) {
      if (distances) {
        searcher_.neighborhood(item.vertex, item.radius, ids_, distances_);
      } else {
        searcher_.neighborhood(item.vertex, item.radius, ids_);
      }
      const BatchMemory memory = receiver.memory(item.row, ids_.size());
      std::copy(ids_.begin(), ids_.end(), memory.ids.begin());
      if (distances) std::copy(distances_.begin(), distances_.end(), memory.distances.begin());
      if (!receiver.done(item.row)) return;
    }
  }

 private:
  S searcher_;
  Begin begin_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

/// A factory from two functions: `make()` returns a worker, `position(v)` is as above.
template <class Make, class Position>
class FactoryOf final : public SearcherFactory {
 public:
  FactoryOf(std::size_t vertex_count, const MethodTraits& traits, Make make, Position position)
      : vertex_count_(vertex_count), traits_(traits), make_(std::move(make)), position_(std::move(position)) {}

  [[nodiscard]] std::size_t vertex_count() const override { return vertex_count_; }
  [[nodiscard]] std::uint32_t position(VertexId v) const override { return position_(v); }
  [[nodiscard]] MethodTraits traits() const override { return traits_; }
  [[nodiscard]] std::unique_ptr<BatchWorker> make_worker() const override { return make_(); }

 private:
  std::size_t vertex_count_;
  MethodTraits traits_;
  Make make_;
  Position position_;
};

}  // namespace meshhood
