// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"

#include "batch/kept_packets.h"
#include "batch/packets.h"
#include "batch/position_sort.h"
#include "batch/row_search.h"
#include "batch/rows.h"
#include "exact/joint/packet_answer.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// Receives the sizes of some rows of a chunk. Returns false to drop the rest of the chunk.
using SizeSink = std::function<bool(std::span<const BatchItem> rows, std::span<const std::uint64_t> sizes)>;

/// Computes chunks of rows by a search, on one thread. The vertices of a chunk ascend in index order. The result of a
/// chunk does not depend on earlier chunks, because which chunks a thread gets differs from run to run.
class BatchWorker {
 public:
  /// `writer` is that of the index. `find` needs it if the search writes pieces.
  explicit BatchWorker(std::unique_ptr<RowSearch> search, std::optional<RowWriter> writer = {})
      : search_(std::move(search)), writer_(writer) {}

  /// `kept` is null, or receives answers, so that a `find` with these `distances` need not search again.
  void count(std::span<const BatchItem> chunk, const SizeSink& sink, KeptPackets* kept, bool distances);

  /// `kept` is null, or reads what `count` kept of the same chunk, none of whose rows was dropped.
  void find(std::span<const BatchItem> chunk, bool distances, RowReceiver& receiver, KeptPackets::Reader* kept);

  /// Passes on the packets of a chunk. `sink` returns false to drop the rest.
  void visit(std::span<const BatchItem> chunk, PacketForm form, const std::function<bool(const PacketAnswer&)>& sink);

 private:
  /// Answers a chunk run by run, and calls `f(items)` after each until it returns false.
  template <class F>
  void for_each_answer(std::span<const BatchItem> chunk, bool distances, F&& f) {
    split(chunk, distances);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!search_run(i, f)) return;
    }
  }

  /// Cuts a chunk into `runs_`.
  void split(std::span<const BatchItem> chunk, bool distances);

  /// Searches run number `i`, its rows together or one by one; `f(rows)` then reads what `search_` has found.
  template <class F>
  bool search_run(std::size_t i, F&& f) {
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
  std::optional<RowWriter> writer_;
  std::vector<RowRun> runs_;
  // The rows of a packet, with an array for each property.
  std::vector<std::size_t> rows_;
  std::vector<VertexId> vertices_;
  std::vector<double> radii_;
};

/// Rows that a thread computes one after the other.
struct BatchChunk {
  std::size_t number;  // of the chunks of a pass
  std::span<const BatchItem> items;
};

/// The common part of all batches: the rows, and threads that process them in chunks that follow the index order.
class Batch {
 public:
  /// The most rows of one call of `for_each_chunk`.
  static constexpr std::size_t kMaxRows = std::size_t{1} << 22;

  /// Shares `method`, borrows `run`, and copies the rest. `passes` is the number of passes over all rows. Throws
  /// Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}.
  Batch(const SearchMethod& method, const BatchQuery& query, const BatchOptions& options, const Run& run,
        std::size_t passes);

  [[nodiscard]] const Rows& rows() const { return rows_; }
  [[nodiscard]] const BatchOptions& options() const { return options_; }
  [[nodiscard]] std::size_t vertex_count() const { return factory_.vertex_count; }
  [[nodiscard]] TaskContext& task() { return task_; }

  /// Begins another pass, with one radius for all rows, which must be valid. Its rows are numbered after those of the
  /// passes before.
  void begin_pass(double radius) {
    rows_.set_radius(radius);
    first_row_ += rows_.size();
  }

  /// Sorts the rows by their position in the index, and returns the former number of each.
  RawVector<std::size_t> put_in_index_order();

  /// Returns whether the positions of the rows ascend.
  [[nodiscard]] bool is_in_index_order() const;

  /// Returns the largest number of rows, in index order from `first` on, that fit the window and end with a group of
  /// leaves. If the window has no whole group, they end with a leaf; if it has no whole leaf, they are all.
  [[nodiscard]] std::size_t whole_units(std::size_t first, std::size_t window) const;

  /// Calls `f(thread, chunk)` for chunks of the rows `row_of(i)`, `i < count`, on any thread. Which chunks there are
  /// depends on the rows alone.
  template <class RowOf, class F>
  void for_each_chunk(std::size_t count, RowOf&& row_of, F&& f);

  /// Does the same for all rows, `kMaxRows` at a time.
  template <class F>
  void for_all_chunks(F&& f);

  /// Returns the worker of a thread, which the thread itself makes at its first use.
  [[nodiscard]] BatchWorker& worker(unsigned thread);

 private:
  /// Each thread has a cache line of its own, because the others write to theirs all the time.
  struct alignas(64) PerThread {
    std::unique_ptr<BatchWorker> worker;
    RawVector<BatchItem> items;  // of its chunk
  };

  /// Sorts the rows `row_of(i)`, `i < count`, by position. Sets `in_order_` and `chunk_ends_`, as the next function.
  template <class RowOf>
  void sort_rows(std::size_t count, RowOf&& row_of);

  /// Takes a row for each vertex, without a sort: the slots are those of an index.
  void take_index_order();

  template <class RowOf, class F>
  void run_chunks(std::size_t first_number, RowOf&& row_of, F&& f);

  /// Returns whether the row after `row` has a position beyond the next multiple of `positions`.
  [[nodiscard]] bool ends_unit(std::size_t row, std::uint32_t positions) const;

  /// Cuts the rows so that those that belong together are in one chunk.
  void cut_into_chunks(std::span<const std::uint64_t> in_order);

  SearchMethod method_;
  const SearcherFactory& factory_;  // of `method_`
  BatchOptions options_;
  Rows rows_;
  std::size_t first_row_ = 0;  // of the pass
  TaskContext task_;
  std::vector<PerThread> threads_;
  RawVector<std::uint64_t> in_order_;    // position, and in the lower half the number `i` of the row
  std::vector<std::size_t> chunk_ends_;  // in `in_order_`
  std::optional<std::size_t> block_;  // the first row, if these are of a block of all rows: another pass needs no sort
};

template <class RowOf, class F>
void Batch::for_each_chunk(std::size_t count, RowOf&& row_of, F&& f) {
  block_.reset();
  sort_rows(count, row_of);
  run_chunks(0, row_of, f);
}

template <class RowOf>
void Batch::sort_rows(std::size_t count, RowOf&& row_of) {
  in_order_ = {};
  in_order_ =
      sorted_by_position(count, [&](std::size_t i) { return factory_.position(rows_.vertex(row_of(i))); }, task_);
  cut_into_chunks(in_order_);
}

template <class RowOf, class F>
void Batch::run_chunks(std::size_t first_number, RowOf&& row_of, F&& f) {
  const std::span<const std::uint64_t> in_order = in_order_;
  task_.parallel_for(chunk_ends_.size(), 1, [&](unsigned thread, std::size_t i, std::size_t) {
    const std::size_t begin = i == 0 ? 0 : chunk_ends_[i - 1];
    threads_[thread].items.clear();
    const std::span<BatchItem> items = add_raw(threads_[thread].items, chunk_ends_[i] - begin);
    for (std::size_t k = 0; k < items.size(); ++k) {
      const std::uint64_t next = in_order[begin + k];
      const std::size_t row = row_of(static_cast<std::uint32_t>(next));
      items[k] = {first_row_ + row, rows_.vertex(row), static_cast<std::uint32_t>(next >> 32), rows_.radius(row)};
    }
    f(thread, BatchChunk{first_number + i, items});
  });
}

template <class F>
void Batch::for_all_chunks(F&& f) {
  std::size_t chunks = 0;
  for (std::size_t first = 0; first < rows_.size(); first += kMaxRows) {
    const std::size_t count = std::min(kMaxRows, rows_.size() - first);
    const auto row_of = [first](std::size_t i) { return first + i; };
    if (block_ != first) {
      block_.reset();
      if (count == rows_.size() && rows_.are_all_vertices() && factory_.of_slots != nullptr) {
        take_index_order();
      } else {
        sort_rows(count, row_of);
      }
      block_ = first;
    }
    run_chunks(chunks, row_of, f);
    chunks += chunk_ends_.size();
  }
}

}  // namespace meshhood::inline v0_1
