// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "meshhood/batch.h"

#include "base/parallel.h"
#include "batch/rows.h"
#include "batch/searcher_factory.h"

namespace meshhood {

/// What all batches share: the rows, and threads that work through them in chunks that follow the index order.
class Batch {
 public:
  /// The most rows of one call of `for_each_chunk`.
  static constexpr std::size_t kMaxRows = std::size_t{1} << 20;

  /// Borrows `method` and `options`. `passes`: how often all rows will be worked through.
  /// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}.
  Batch(const SearchMethod& method, const BatchQuery& query, const BatchOptions& options, std::size_t passes);

  [[nodiscard]] const Rows& rows() const { return rows_; }
  [[nodiscard]] const BatchOptions& options() const { return options_; }
  [[nodiscard]] std::size_t vertex_count() const { return factory_.vertex_count(); }
  [[nodiscard]] TaskContext& task() { return task_; }

  /// Calls `f(thread, worker, items)` for chunks of the rows `row_of(i)`, `i < count`, on any thread. Which chunks
  /// there are depends on the rows alone, and `worker` belongs to the thread.
  template <class RowOf, class F>
  void for_each_chunk(std::size_t count, RowOf&& row_of, F&& f);

 private:
  static constexpr std::size_t kMaxChunk = 32;

  [[nodiscard]] BatchWorker& worker(unsigned thread);

  const SearcherFactory& factory_;
  const BatchOptions& options_;
  Rows rows_;
  TaskContext task_;
  std::vector<std::unique_ptr<BatchWorker>> workers_;  // by thread, each made by the thread itself
  std::vector<std::uint64_t> in_order_;                // position, and in the lower half the number `i` of the row
};

template <class RowOf, class F>
void Batch::for_each_chunk(std::size_t count, RowOf&& row_of, F&& f) {
  in_order_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    in_order_[i] = (std::uint64_t{factory_.position(rows_.vertex(row_of(i)))} << 32) + i;
  }
  std::sort(in_order_.begin(), in_order_.end());
  // Few rows may be large: each is a chunk of its own.
  const std::size_t grain = std::clamp<std::size_t>(count / kMaxChunk, 1, kMaxChunk);
  task_.parallel_for(count, grain, [&](unsigned thread, std::size_t begin, std::size_t end) {
    std::array<BatchItem, kMaxChunk> items;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t row = row_of(static_cast<std::uint32_t>(in_order_[i]));
      items[i - begin] = {row, rows_.vertex(row), rows_.radius(row)};
    }
    f(thread, worker(thread), std::span<const BatchItem>(items).first(end - begin));
  });
}

}  // namespace meshhood
