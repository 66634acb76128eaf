// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "meshhood/batch.h"

#include "batch/batch_index.h"
#include "batch/rows.h"
#include "parallel.h"

namespace meshhood {

/// One thread's part of a batch.
struct BatchWorker {
  std::unique_ptr<BatchSearcher> searcher;  // made by the thread itself
  std::vector<VertexId> ids;                // of the last answer
  std::vector<double> distances;
};

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
  [[nodiscard]] Work& work() { return work_; }

  /// Calls `f(thread, row)` for each of the rows `first .. first + count - 1`, at most `kMostRows`, on any thread, near
  /// ones one after the other. A thread drops the rest of its chunk when `f` returns false.
  template <class F>
  void for_each_row(std::size_t first, std::size_t count, F&& f);

  /// The answer of a row. Only from `for_each_row`, where its order depends on the rows alone, not on the threads.
  const BatchWorker& ask(unsigned thread, std::size_t row);
  [[nodiscard]] std::size_t count(unsigned thread, std::size_t row);

 private:
  void put_in_index_order(std::size_t first, std::size_t count);
  void begin_chunk(unsigned thread);

  const BatchIndex& index_;
  const BatchOptions& options_;
  Rows rows_;
  Work work_;
  std::vector<BatchWorker> workers_;     // by thread
  std::vector<std::uint64_t> in_order_;  // place and row, the latter from the first of its call
};

template <class F>
void Batch::for_each_row(std::size_t first, std::size_t count, F&& f) {
  // Few rows, that may be large, are shared out one by one.
  constexpr std::size_t kChunk = 32;
  put_in_index_order(first, count);
  work_.parallel_for(count, std::clamp<std::size_t>(count / kChunk, 1, kChunk),
                     [&](unsigned thread, std::size_t begin, std::size_t end) {
                       begin_chunk(thread);
                       for (std::size_t i = begin; i < end && work_.proceed(thread); ++i) {
                         if (!f(thread, first + static_cast<std::uint32_t>(in_order_[i]))) return;
                       }
                     });
}

/// The public calls, for either index.
void for_each_neighborhood(const BatchIndex& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options);
[[nodiscard]] Neighborhoods neighborhoods(const BatchIndex& index, const BatchQuery& query,
                                          const BatchOptions& options);
[[nodiscard]] std::vector<std::uint64_t> counts(const BatchIndex& index, const BatchQuery& query,
                                                const BatchOptions& options);

}  // namespace meshhood
