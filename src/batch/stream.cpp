// SPDX-License-Identifier: MIT
// Rows in their order and in bounded memory, though asked in index order: a window of rows is worked off in any order,
// then handed out in theirs.
#include <algorithm>
#include <atomic>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "batch/batch.h"

namespace meshhood {
namespace {

// Before anything is known of how large rows are.
constexpr std::size_t kFirstWindow = 256;
constexpr std::size_t kGrowth = 4;

// Large rows take as long to be written to memory as to be found, unless what waits stays in the cache. Small ones gain
// more from a long window, in which more of them lie close together.
constexpr double kLargeRow = 1024;
constexpr double kCached = 1 << 20;

/// Values one after the other in memory that is not set to zero first.
template <class T>
class Values {
 public:
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const T> part(std::size_t begin, std::size_t size) const {
    return {values_.get() + begin, size};
  }

  /// Makes room for `count` more, and for `spare` that may be written but do not stay, and returns where.
  T* append(std::size_t count, std::size_t spare) {
    const std::size_t needed = size_ + count + spare;
    if (needed > capacity_) {
      const std::size_t capacity = std::max(needed, 2 * capacity_);
      auto larger = std::make_unique_for_overwrite<T[]>(capacity);  // NOLINT(modernize-avoid-c-arrays)
      std::copy_n(values_.get(), size_, larger.get());
      values_ = std::move(larger);
      capacity_ = capacity;
    }
    T* begin = values_.get() + size_;
    size_ += count;
    return begin;
  }

 private:
  std::unique_ptr<T[]> values_;  // NOLINT(modernize-avoid-c-arrays): a vector would write to all of it
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

class Stream {
 public:
  Stream(Batch& batch, const RowSink& sink) : batch_(batch), sink_(sink), stores_(batch.task().threads()) {}

  /// Windows depend on the rows alone, so that answers do, too (see `Batch::for_each_row`).
  void run() {
    std::size_t window = kFirstWindow;
    for (std::size_t first = 0; first < batch_.rows().size();) {
      window = std::min(window, batch_.rows().size() - first);
      if (fill(first, window)) {
        hand_out(first);
        first += window;
        window = next_window(window);
      } else {
        window = (window + kGrowth - 1) / kGrowth;
      }
    }
  }

 private:
  /// The answers of one thread that wait for their turn.
  struct Store {
    Values<VertexId> ids;
    Values<double> distances;
  };

  /// A row's part of a store.
  struct Waiting {
    unsigned thread;
    std::size_t begin;
    std::size_t size;
  };

  /// Asks `window` rows; false if they need more memory than they may have, and are more than one.
  bool fill(std::size_t first, std::size_t window) {
    const std::size_t room = batch_.options().buffer_bytes;
    waiting_.resize(window);
    for (Store& store : stores_) {
      store.ids.clear();
      store.distances.clear();
    }
    bytes_ = 0;
    batch_.for_each_row(first, window, [&](unsigned thread, std::size_t row) {
      if (bytes_ > room && window > 1) return false;
      waiting_[row - first] = keep(thread, batch_.search(thread, row));
      bytes_ += bytes_of(waiting_[row - first]);
      return true;
    });
    return bytes_ <= room || window == 1;
  }

  Waiting keep(unsigned thread, std::size_t size) {
    Store& store = stores_[thread];
    const Waiting row{thread, store.ids.size(), size};
    VertexId* ids = store.ids.append(size, BatchSearcher::kRoom);
    batch_.write(thread, size, ids, batch_.options().distances ? store.distances.append(size, 0) : nullptr);
    return row;
  }

  [[nodiscard]] std::size_t bytes_of(const Waiting& row) const {
    return sizeof(Waiting) + row.size * (sizeof(VertexId) + (batch_.options().distances ? sizeof(double) : 0));
  }

  void hand_out(std::size_t first) {
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const Waiting& row = waiting_[i];
      const Store& store = stores_[row.thread];
      const auto distances =
          batch_.options().distances ? store.distances.part(row.begin, row.size) : std::span<const double>();
      sink_({first + i, store.ids.part(row.begin, row.size), distances});
      batch_.task().advance(1);
      batch_.task().should_continue(0);
    }
  }

  /// As many rows as will probably fit, some room left over.
  [[nodiscard]] std::size_t next_window(std::size_t window) const {
    const double row = static_cast<double>(bytes_) / static_cast<double>(window);
    const auto most = static_cast<double>(batch_.options().buffer_bytes);
    const double room = row < kLargeRow ? 0.75 * most : std::min(0.75 * most, kCached);
    const double rows = std::min(room / row, static_cast<double>(kGrowth * window));
    return std::clamp<std::size_t>(static_cast<std::size_t>(rows), 1, Batch::kMostRows);
  }

  Batch& batch_;
  const RowSink& sink_;
  std::vector<Store> stores_;     // by thread
  std::vector<Waiting> waiting_;  // the rows of the window
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace

void for_each_neighborhood(const BatchIndex& index, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options) {
  if (!sink) raise(ErrorCode::InvalidOption, "sink is empty, expected a function");
  Batch batch(index, query, options, 1);
  Stream(batch, sink).run();
  batch.task().report_progress();
}

}  // namespace meshhood
