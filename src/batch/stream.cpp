// SPDX-License-Identifier: MIT
// Rows in their order and in bounded memory, though asked in index order: a window of rows is worked off in any order,
// then handed out in theirs.
#include <atomic>
#include <vector>

#include "meshhood/error.h"

#include "batch/batch.h"

namespace meshhood {
namespace {

// Before anything is known of how large rows are.
constexpr std::size_t kFirstWindow = 256;
constexpr std::size_t kGrowth = 4;

class Stream {
 public:
  Stream(Batch& batch, const RowSink& sink) : batch_(batch), sink_(sink), stores_(batch.work().threads()) {}

  /// Windows depend on the rows alone, so that answers do, too (see `Batch::ask`).
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
    std::vector<VertexId> ids;
    std::vector<double> distances;
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
      bytes_ += keep(thread, batch_.ask(thread, row), waiting_[row - first]);
      return true;
    });
    return bytes_ <= room || window == 1;
  }

  std::size_t keep(unsigned thread, const BatchWorker& answer, Waiting& waiting) {
    Store& store = stores_[thread];
    waiting = {thread, store.ids.size(), answer.ids.size()};
    store.ids.insert(store.ids.end(), answer.ids.begin(), answer.ids.end());
    store.distances.insert(store.distances.end(), answer.distances.begin(), answer.distances.end());
    return sizeof(Waiting) + answer.ids.size() * sizeof(VertexId) + answer.distances.size() * sizeof(double);
  }

  void hand_out(std::size_t first) {
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      const Waiting& row = waiting_[i];
      const Store& store = stores_[row.thread];
      const auto distances = batch_.options().distances ? std::span(store.distances).subspan(row.begin, row.size)
                                                        : std::span<const double>();
      sink_({first + i, std::span(store.ids).subspan(row.begin, row.size), distances});
      batch_.work().advance(1);
      batch_.work().proceed(0);
    }
  }

  /// As many rows as will probably fit, some room left over.
  [[nodiscard]] std::size_t next_window(std::size_t window) const {
    const double fitting = 0.75 * static_cast<double>(batch_.options().buffer_bytes) / static_cast<double>(bytes_);
    const double rows = std::min(fitting, static_cast<double>(kGrowth)) * static_cast<double>(window);
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
  batch.work().report();
}

}  // namespace meshhood
