// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "meshhood/run.h"

#include "io/waiting.h"

namespace meshhood::cli {

/// The unit of the parts of a task, for the displayed rate.
struct Unit {
  std::string_view name = {};  ///< "rows"; empty: no rate is displayed
  double parts = 1;            ///< parts per unit
};

/// One long operation of a command; one object at a time. While it lives
///  - a line on standard error shows the progress, the rate and the time left: only on a terminal, only after a second,
///    and removed at the end;
///  - SIGINT, SIGHUP, SIGTERM and SIGXCPU do not end the program. `progress()` then returns false, so that the
///    operation throws Error{Cancelled} and removes its temporary file. So does one that waits for another process at
///    a pipe, or for a terminal. On Windows, Ctrl-C and Ctrl-Break, but not during such a wait.
class Task {
 public:
  explicit Task(std::string_view description, Unit unit = {});
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  /// For the operation, or for pass number `pass` of `passes` that take about as long. Borrows the task.
  [[nodiscard]] Progress progress(std::size_t pass = 0, std::size_t passes = 1);

  /// Throws Error{Cancelled} if a signal has arrived.
  static void check_cancelled();

 private:
  void show();
  void draw(double seconds) const;

  io::WhileWaiting waiting_{check_cancelled};
  std::string description_;
  Unit unit_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<std::size_t> total_ = 0;  // 0 if it is unknown
  std::mutex mutex_;
  std::condition_variable finished_;
  bool is_finished_ = false;
  std::thread display_;
};

}  // namespace meshhood::cli
