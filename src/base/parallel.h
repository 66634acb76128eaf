// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

#include "meshhood/progress.h"

namespace meshhood {

/// A long call: the threads it may use, and who watches how far it is. Belongs to the thread that made the call, which
/// takes part in all of the work as number 0.
class TaskContext {
 public:
  /// threads     0: as many as the processor has; one where there are none to be had, as in WebAssembly.
  /// progress    may be empty; must outlive the task. Told of `total` parts.
  /// Throws Error{InvalidOption, Cancelled}.
  TaskContext(unsigned threads, const Progress& progress, std::size_t total);

  [[nodiscard]] unsigned threads() const { return threads_; }

  /// Calls `f(thread, begin, end)` for consecutive chunks of `grain` of the numbers `0 .. count - 1`, each on any of
  /// the threads; which chunks there are does not depend on how many threads. Returns when no thread runs any more.
  /// The first exception ends the loop and is then passed on.
  template <class F>
  void parallel_for(std::size_t count, std::size_t grain, F&& f);

  /// Any thread: so many more of the parts are done.
  void advance(std::size_t parts) { done_.fetch_add(parts, std::memory_order_relaxed); }

  /// Whether to go on; to be asked in the midst of a chunk that takes long. Thread 0 reports progress if it is time,
  /// and throws what comes of it.
  bool should_continue(unsigned thread) {
    if (thread == 0 && *progress_ && std::chrono::steady_clock::now() >= next_report_) report_progress();
    return !stopped_.load(std::memory_order_relaxed);
  }

  /// Thread 0: reports progress. Throws Error{Cancelled}.
  void report_progress();

 private:
  /// Calls `body(thread)` on up to `threads` threads at once.
  void run(std::size_t threads, const std::function<void(unsigned)>& body);

  unsigned threads_;
  const Progress* progress_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> stopped_{false};
  std::chrono::steady_clock::time_point next_report_;
};

template <class F>
void TaskContext::parallel_for(std::size_t count, std::size_t grain, F&& f) {
  std::atomic<std::size_t> next{0};
  run((count + grain - 1) / grain, [&](unsigned thread) {
    for (;;) {
      const std::size_t begin = next.fetch_add(grain, std::memory_order_relaxed);
      if (begin >= count || !should_continue(thread)) return;
      f(thread, begin, std::min(begin + grain, count));
    }
  });
}

}  // namespace meshhood
