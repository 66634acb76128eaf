// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "exact/query/path_buckets.h"

namespace meshhood {

/// A priority queue of paths that are never shorter than the one taken last: a calendar queue (Brown 1988).
///
/// The paths of a *window* of lengths lie in buckets of equal width; longer ones wait in a list. A bucket is opened and
/// sorted when all before it are empty. A path that comes to the open bucket goes to a heap. When the window is empty,
/// the next one begins, wide enough for all that wait. So a path is moved at most twice, and compared only with those
/// of its bucket, of which there are few if the buckets are narrow. Where they are not, the queue is as fast as a heap.
class PathQueue {
 public:
  /// Removes all paths. `width` is that of a bucket, where nothing requires a larger one; finite, and not negative.
  void clear(double width);

  /// Room for `count` paths, of which the first may then be pushed. Valid until the next call.
  [[nodiscard]] Path* room(std::size_t count) {
    if (pushed_.size() < pushed_count_ + count) pushed_.resize(pushed_count_ + count);
    return pushed_.data() + pushed_count_;
  }

  /// Adds the first `count` paths in the room, whose lengths are finite, and none of which is shorter than `least`.
  void push(std::size_t count, double least) {
    pushed_count_ += count;
    least_pushed_ = std::min(least_pushed_, least);
  }

  /// Takes a shortest path among those for which `is_valid(path)` holds. The others are dropped. Returns whether there
  /// is one. Calls `prepare(path)` some time before.
  template <class IsValid, class Prepare>
  bool pop(Path& path, IsValid&& is_valid, Prepare&& prepare) {
    do {
      if (position(least_pushed_) < static_cast<double>(open_ + 1)) file_pushed();
      if (sorted_.empty() && late_.empty() && !open_next_bucket(is_valid, prepare)) return false;
      path = take_first();
    } while (!is_valid(path));
    return true;
  }

 private:
  /// The bucket of a length, with a fraction. Never decreases if the length grows.
  [[nodiscard]] double position(double length) const { return (length - base_) * scale_; }

  /// Opens the next bucket that has valid paths.
  template <class IsValid, class Prepare>
  bool open_next_bucket(IsValid&& is_valid, Prepare&& prepare) {
    file_pushed();
    while (sorted_.empty()) {
      open_ = buckets_.find_from(open_);
      if (open_ == PathBuckets::kCount && !begin_window()) return false;
      bucket_.clear();
      buckets_.take(open_, [&](const Path& path) {
        prepare(path);
        if (is_valid(path)) bucket_.push_back(path);
      });
      sort_bucket();
    }
    return true;
  }

  Path take_first();
  void file_pushed();
  bool begin_window();
  void sort_bucket();
  template <std::size_t kMost>
  void sort_few();

  double width_ = 0;  // the least width of a bucket
  double base_ = 0;   // where the window begins
  double scale_ = 0;  // buckets in a unit of length
  PathBuckets buckets_;
  std::vector<Path> beyond_;  // the window
  std::size_t open_ = 0;      // the number of the open bucket
  std::vector<Path> bucket_;  // its valid paths
  std::vector<Path> sorted_;  // what is left of them, descending
  std::vector<Path> late_;    // a heap: those that came to it since
  std::vector<Path> pushed_;  // the first `pushed_count_` are not filed yet
  std::size_t pushed_count_ = 0;
  double least_pushed_ = 0;  // none of them is shorter
};

}  // namespace meshhood
