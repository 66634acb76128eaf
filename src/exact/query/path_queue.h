// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "exact/query/path_buckets.h"

namespace meshhood {

/// Paths in buckets by their length, taken a bucket at a time, as in a calendar queue (Brown 1988).
///
/// The paths of a *window* of lengths lie in buckets of equal width; longer ones wait in a list. When the window is
/// empty, the next one begins, wide enough for all that wait. So a path is moved at most twice.
class PathQueue {
 public:
  /// Removes all paths. `width` is that of a bucket, where nothing requires a larger one; finite, and not negative.
  void clear(double width);

  /// Adds a path of finite length, which is not shorter than those of the open bucket were.
  void push(const Path& path) {
    const double at = position(path.length);
    if (at < PathBuckets::kCount) {
      buckets_.add(static_cast<std::size_t>(at), path);
    } else {
      beyond_.push_back(path);
    }
  }

  /// Opens the first bucket that has paths, which may be the open one again. Returns whether there is one.
  [[nodiscard]] bool open();

  /// Removes the paths of the open bucket, and calls `f(path)` for each.
  template <class F>
  void take(F&& f) {
    buckets_.take(open_, f);
  }

 private:
  /// The bucket of a length, with a fraction. Never decreases if the length grows.
  [[nodiscard]] double position(double length) const { return (length - base_) * scale_; }
  void begin_window();

  double width_ = 0;  // the least width of a bucket
  double base_ = 0;   // where the window begins
  double scale_ = 0;  // buckets in a unit of length
  PathBuckets buckets_;
  std::vector<Path> beyond_;  // the window
  std::size_t open_ = 0;      // the number of the open bucket
};

}  // namespace meshhood
