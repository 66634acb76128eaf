// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace meshhood::cli {

/// A line on standard error that says what takes so long: only on a terminal, only after a second, and gone at the end.
class Progress {
 public:
  explicit Progress(std::string_view what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// How much is done, from 0 to 1, or so many parts of `total`. Without it, the line shows the time alone.
  void report(double fraction) { fraction_ = fraction; }
  void report(std::size_t done, std::size_t total) {
    report(total == 0 ? 1 : static_cast<double>(done) / static_cast<double>(total));
  }

 private:
  void watch(const std::stop_token& stop);
  void draw(double seconds) const;

  std::string what_;
  std::atomic<double> fraction_{-1.0};
  std::mutex mutex_;
  std::condition_variable_any finished_;
  std::jthread watcher_;  // last, so that it ends before what it uses
};

}  // namespace meshhood::cli
