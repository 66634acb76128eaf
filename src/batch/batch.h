// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "meshhood/batch.h"

#include "base/parallel.h"
#include "batch/batch_index.h"
#include "batch/rows.h"

namespace meshhood {

/// What all batches have in common: rows are asked in chunks that follow the index order, each by any of the threads.
class Batch {
 public:
  /// So many rows at a time.
  static constexpr std::size_t kMostRows = std::size_t{1} << 20;

  /// Everything is borrowed. `passes`: how often all rows will be gone through.
  /// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}.
  Batch(const BatchIndex& index, const BatchQuery& query, const BatchOptions& options, std::size_t passes);

  [[nodiscard]] const Rows& rows() const { return rows_; }
  [[nodiscard]] const BatchOptions& options() const { return options_; }
  [[nodiscard]] TaskContext& task() { return task_; }

  /// Calls `f(thread, row)` for each of the rows `first .. first + count - 1`, at most `kMostRows`, on any thread, near
  /// ones one after the other. A thread drops the rest of its chunk when `f` returns false.
  template <class F>
  void for_each_row(std::size_t first, std::size_t count, F&& f);

  /// Finds the answer of a row and returns its size. Only from `for_each_row`, where the order of the answer depends on
  /// the rows alone, not on the threads.
  [[nodiscard]] std::size_t search(unsigned thread, std::size_t row);

  /// Writes the answer that the thread found last. `distances` is null where none are asked for; `ids` has room for
  /// `BatchSearcher::kRoom` more than `size`.
  void write(unsigned thread, std::size_t size, VertexId* ids, double* distances);

  [[nodiscard]] std::size_t count(unsigned thread, std::size_t row);

 private:
  void put_in_index_order(std::size_t first, std::size_t count);
  void begin_chunk(unsigned thread);

  const BatchIndex& index_;
  const BatchOptions& options_;
  Rows rows_;
  TaskContext task_;
  std::vector<std::unique_ptr<BatchSearcher>> searchers_;  // by thread, each made by the thread itself
  std::vector<std::uint64_t> in_order_;                    // place and row, the latter from the first of its call
};

template <class F>
void Batch::for_each_row(std::size_t first, std::size_t count, F&& f) {
  // Few rows, that may be large, are shared out one by one.
  constexpr std::size_t kChunk = 32;
  put_in_index_order(first, count);
  task_.parallel_for(count, std::clamp<std::size_t>(count / kChunk, 1, kChunk),
                     [&](unsigned thread, std::size_t begin, std::size_t end) {
                       begin_chunk(thread);
                       for (std::size_t i = begin; i < end && task_.should_continue(thread); ++i) {
                         if (!f(thread, first + static_cast<std::uint32_t>(in_order_[i]))) return;
                       }
                     });
}

/// The public calls, for either index.
void for_each_neighborhood(const BatchIndex& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options);
[[nodiscard]] Neighborhoods neighborhoods(const BatchIndex& index, const BatchQuery& query,
                                          const BatchOptions& options);
[[nodiscard]] std::vector<std::uint64_t> neighborhoods(const BatchIndex& index, const BatchQuery& query,
                                                       const BatchAllocator& allocate, const BatchOptions& options);
[[nodiscard]] std::vector<std::uint64_t> neighborhood_sizes(const BatchIndex& index, const BatchQuery& query,
                                                            const BatchOptions& options);

}  // namespace meshhood
