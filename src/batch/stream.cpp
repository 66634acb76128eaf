// SPDX-License-Identifier: MIT
// Passes on rows in order, in bounded memory: a window of rows is computed in index order, then passed on in row order.
#include <algorithm>
#include <atomic>
#include <span>
#include <utility>
#include <vector>

#include "batch/batch.h"
#include "shared/raw_vector.h"
#include "shared/row_order.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {
namespace {

// The size of the first windows, while the size of rows is not known.
constexpr std::size_t kFirstWindow = 256;
constexpr std::size_t kGrowth = 4;

/// The rows of a window that one thread computed.
struct Store {
  RawVector<VertexId> ids;
  RawVector<double> distances;

  void clear() {
    ids.clear();
    distances.clear();
  }

  /// Adds memory for a row, with `size` distances if they are requested.
  BatchMemory add(std::size_t size, bool with_distances) {
    return {add_raw(ids, size), with_distances ? add_raw(distances, size) : std::span<double>()};
  }
};

/// Passes on each row as soon as it is computed, on one thread, if the rows are in index order.
class DirectRows final : public RowReceiver {
 public:
  DirectRows(Batch& batch, const RowSink& sink, std::span<const std::size_t> row_of)
      : batch_(batch), sink_(sink), row_of_(row_of), order_(batch.options().sort) {}

  void run() {
    batch_.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
      batch_.worker(thread).find(chunk.items, batch_.options().distances, *this, nullptr);
    });
  }

  BatchMemory memory(std::size_t /*row*/, std::size_t size) override {
    store_.clear();
    return last_ = store_.add(size, batch_.options().distances);
  }

  bool done(std::size_t row) override {
    order_.sort(last_.ids, last_.distances);
    sink_({row_of_.empty() ? row : row_of_[row], last_.ids, last_.distances});
    batch_.task().advance(1);
    return batch_.task().should_continue(0);
  }

 private:
  Batch& batch_;
  const RowSink& sink_;
  std::span<const std::size_t> row_of_;
  Store store_;
  BatchMemory last_;
  RowOrder order_;
};

class Stream {
 public:
  Stream(Batch& batch, const RowSink& sink) : batch_(batch), sink_(sink), stores_(batch.task().threads()) {
    if (batch.options().in_index_order) row_of_ = batch.put_in_index_order();
  }

  void run() {
    if (batch_.task().threads() == 1 && batch_.is_in_index_order()) {
      DirectRows(batch_, sink_, row_of_).run();
    } else {
      run_windows();
    }
  }

 private:
  /// Where a row is: `store[begin .. begin + size - 1]` of the thread's store.
  struct Waiting {
    unsigned thread;
    std::size_t begin;
    std::size_t size;
  };

  /// Keeps the rows of a window. It seldom adds their bytes to those of the window (see `share_at_once`).
  class WindowRows final : public RowReceiver {
   public:
    WindowRows(Stream& stream, unsigned thread, std::size_t first)
        : stream_(stream),
          thread_(thread),
          first_(first),
          bytes_at_once_(share_at_once(stream.batch_.options().buffer_bytes, stream.batch_.task().threads())),
          order_(stream.batch_.options().sort) {}
    WindowRows(const WindowRows&) = delete;
    WindowRows& operator=(const WindowRows&) = delete;
    ~WindowRows() override { stream_.bytes_ += new_bytes_; }

    BatchMemory memory(std::size_t row, std::size_t size) override {
      Store& store = stream_.stores_[thread_];
      const Waiting& kept = stream_.waiting_[row - first_] = {thread_, store.ids.size(), size};
      new_bytes_ += stream_.bytes_of(kept);
      if (new_bytes_ >= bytes_at_once_) stream_.bytes_ += std::exchange(new_bytes_, 0);
      return last_ = store.add(size, stream_.batch_.options().distances);
    }

    bool done(std::size_t /*row*/) override {
      order_.sort(last_.ids, last_.distances);
      return stream_.fits() && stream_.batch_.task().should_continue(thread_);
    }

   private:
    Stream& stream_;
    unsigned thread_;
    std::size_t first_;
    std::size_t bytes_at_once_;
    std::size_t new_bytes_ = 0;
    BatchMemory last_;
    RowOrder order_;
  };

  /// Windows depend on the rows alone, and so does what is searched together (see `Batch::for_each_chunk`).
  void run_windows() {
    std::size_t window = kFirstWindow;
    for (std::size_t first = 0; first < batch_.rows().size();) {
      window = std::min(window, batch_.rows().size() - first);
      if (!row_of_.empty()) window = batch_.whole_units(first, window);
      if (fill(first, window)) {
        pass_on(first);
        first += window;
        window = next_window(window);
      } else {
        window = (window + kGrowth - 1) / kGrowth;
      }
    }
  }

  /// Computes `window` rows. Returns false if there are several and they need more memory than the limit.
  bool fill(std::size_t first, std::size_t window) {
    waiting_.resize(window);
    for (Store& store : stores_) store.clear();
    bytes_ = 0;
    batch_.for_each_chunk(
        window, [first](std::size_t i) { return first + i; },
        [&](unsigned thread, const BatchChunk& chunk) {
          WindowRows receiver(*this, thread, first);
          batch_.worker(thread).find(chunk.items, batch_.options().distances, receiver, nullptr);
        });
    return fits();
  }

  [[nodiscard]] bool fits() const { return bytes_ <= batch_.options().buffer_bytes || waiting_.size() == 1; }

  [[nodiscard]] std::size_t bytes_of(const Waiting& row) const {
    return sizeof(Waiting) + row.size * (sizeof(VertexId) + (batch_.options().distances ? sizeof(double) : 0));
  }

  void pass_on(std::size_t first) {
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const Waiting& row = waiting_[i];
      const Store& store = stores_[row.thread];
      const auto distances = batch_.options().distances ? std::span(store.distances).subspan(row.begin, row.size)
                                                        : std::span<const double>();
      sink_({row_of_.empty() ? first + i : row_of_[first + i], std::span(store.ids).subspan(row.begin, row.size),
             distances});
      batch_.task().advance(1);
      batch_.task().should_continue(0);
    }
  }

  /// Returns the number of rows that will probably fit, with a margin.
  [[nodiscard]] std::size_t next_window(std::size_t window) const {
    const double row = static_cast<double>(bytes_) / static_cast<double>(window);
    const auto most = static_cast<double>(batch_.options().buffer_bytes);
    const double rows = std::min(0.75 * most / row, static_cast<double>(kGrowth * window));
    return std::clamp<std::size_t>(static_cast<std::size_t>(rows), 1, Batch::kMaxRows);
  }

  Batch& batch_;
  const RowSink& sink_;
  RawVector<std::size_t> row_of_;  // by place in the stream, if that is not in row order
  std::vector<Store> stores_;      // by thread
  std::vector<Waiting> waiting_;   // the rows of the window
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace

void for_each_neighborhood(const SearchMethod& method, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options, const Run& run) {
  check_function(sink, "sink");
  Batch batch(method, query, options, run, 1);
  Stream(batch, sink).run();
  batch.task().finish();
}

}  // namespace meshhood::inline v0_1
