// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#if defined(__linux__)
#include <ctime>
#endif

#include "meshhood/export.h"
#include "meshhood/run.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

class HelperThreads;

/// Returns the time of `std::chrono::steady_clock`, on Linux up to ten milliseconds late. A batch with progress reads
/// it for each row, and reading the exact time takes 8 % of a small row.
inline std::chrono::steady_clock::time_point coarse_time() {
  using Clock = std::chrono::steady_clock;
#if defined(__linux__)
  timespec now{};
  if (clock_gettime(CLOCK_MONOTONIC_COARSE, &now) == 0) {
    const auto since = std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
    return Clock::time_point(std::chrono::duration_cast<Clock::duration>(since));
  }
#endif
  return Clock::now();
}

/// Holds the threads of a long call, its progress and whether it was cancelled. It belongs to the calling thread, which
/// takes part in the work as thread 0.
class TaskContext {
 public:
  /// threads     0: one per processor; always one if the platform has no threads, as WebAssembly.
  /// progress    may be empty; must outlive the task. Receives the number of parts done, of `total`.
  /// Reports the beginning. Throws Error{InvalidOption, Cancelled}.
  TaskContext(unsigned threads, const Progress& progress, std::size_t total);

  /// Makes a task that has no progress and is never cancelled. Throws Error{InvalidOption}.
  explicit TaskContext(unsigned threads);

  /// Makes such a task with one thread, and throws nothing.
  TaskContext();

  TaskContext(const TaskContext&) = delete;
  TaskContext& operator=(const TaskContext&) = delete;
  ~TaskContext();

  [[nodiscard]] unsigned threads() const { return threads_; }

  /// Calls `f(thread, begin, end)` for consecutive chunks of `grain` of the numbers `0 .. count - 1`, each on any
  /// thread: first those of its share, which are consecutive, so that loops over the same data find them in its cache;
  /// then what is left of other shares. The chunks do not depend on the number of threads. Returns when all threads
  /// have stopped. The first exception ends the loop and is passed on. `f` must not begin another loop of this task.
  template <class F>
  void parallel_for(std::size_t count, std::size_t grain, F&& f);

  /// Counts `parts` that `thread` has done in a loop.
  void advance(unsigned thread, std::size_t parts) {
    assert(thread < shares_.size());
    std::atomic<std::size_t>& done = shares_[thread].done;
    done.store(done.load(std::memory_order_relaxed) + parts, std::memory_order_relaxed);
  }

  /// Counts `parts` that thread 0 has done.
  void advance(std::size_t parts) { done_ += parts; }

  /// Returns whether to continue; to be called within chunks that take long. Thread 0 reports progress if it is due,
  /// and may throw as `report_progress`.
  bool should_continue(unsigned thread) {
    if (thread == 0 && *progress_ && coarse_time() >= next_report_) report_progress();
    return !stopped_.load(std::memory_order_relaxed);
  }

  /// Reports progress now, on thread 0. Throws Error{Cancelled}, or what the callback throws.
  void report_progress();

  /// Counts `parts` that thread 0 has done, and reports progress.
  void step(std::size_t parts = 1) {
    advance(parts);
    report_progress();
  }

  /// Counts all parts as done, also those that turned out not to be needed, and reports it. Not to be called in a loop.
  void finish();

 private:
  /// Each thread has a share, in a cache line of its own, because the others change theirs all the time.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};  // of the chunks that this thread begins with, the first that is left
    std::size_t end = 0;               // the chunk after these
    std::atomic<std::size_t> done{0};  // parts of the task, by this thread
  };

  /// Divides the chunks of a loop among the threads, or among as many as there are chunks.
  [[nodiscard]] std::span<Share> divide(std::size_t chunks);

  /// Calls `body(thread)` on up to `threads` threads at once, at most `threads()`.
  void run(std::size_t threads, const std::function<void(unsigned)>& body);

  /// Throws Error{Cancelled} in a child that was forked while the task had threads.
  void check_not_forked() const;

  unsigned threads_;
  const Progress* progress_;
  std::size_t total_;
  std::size_t done_ = 0;                    // without those of the shares
  std::vector<Share> shares_;               // made by the first loop
  std::unique_ptr<HelperThreads> helpers_;  // made by the first loop of more than one thread
  std::chrono::steady_clock::time_point next_report_;
  std::atomic<bool> stopped_{false};
};

template <class F>
void TaskContext::parallel_for(std::size_t count, std::size_t grain, F&& f) {
  const std::span<Share> shares = divide((count + grain - 1) / grain);
  run(shares.size(), [&](unsigned thread) {
    for (std::size_t i = 0; i < shares.size(); ++i) {
      Share& share = shares[(thread + i) % shares.size()];
      // Threads read before they add: a share that has ended then stays in the caches of all processors.
      while (share.next.load(std::memory_order_relaxed) < share.end) {
        const std::size_t chunk = share.next.fetch_add(1, std::memory_order_relaxed);
        if (chunk >= share.end) break;
        if (!should_continue(thread)) return;
        f(thread, chunk * grain, std::min((chunk + 1) * grain, count));
      }
    }
  });
}

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
