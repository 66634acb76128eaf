// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood::inline v0_1 {

/// A path of edges.
struct Path {
  double length;
  std::uint32_t end;  // a vertex, in index order
};

/// Lists of paths by number. Their memory is used again at once, so it stays in the cache.
class PathBuckets {
 public:
  static constexpr std::size_t kCount = 1024;

  void clear() {
    occupied_ = {};
    entries_.clear();
    free_ = kNone;
  }

  void add(std::size_t bucket, const Path& path) {
    assert(bucket < kCount);
    if (free_ == kNone) {
      free_ = static_cast<std::uint32_t>(entries_.size());
      entries_.push_back({{}, kNone});
    }
    Entry& entry = entries_[free_];
    std::uint64_t& word = occupied_[bucket / 64];
    const std::uint64_t bit = std::uint64_t{1} << bucket % 64;
    const std::uint32_t rest = (word & bit) != 0 ? first_[bucket] : kNone;
    first_[bucket] = free_;
    free_ = entry.next;
    entry = {path, rest};
    word |= bit;
  }

  /// The first bucket from `bucket` on that has paths, or `kCount`.
  [[nodiscard]] std::size_t find_from(std::size_t bucket) const {
    assert(bucket < kCount);
    std::uint64_t word = occupied_[bucket / 64] >> bucket % 64 << bucket % 64;
    for (std::size_t i = bucket / 64;; word = occupied_[i]) {
      if (word != 0) return 64 * i + static_cast<std::size_t>(std::countr_zero(word));
      if (++i == occupied_.size()) return kCount;
    }
  }

  /// Removes the paths of a bucket, and calls `f(path)` for each.
  template <class F>
  void take(std::size_t bucket, F&& f) {
    const std::uint64_t bit = std::uint64_t{1} << bucket % 64;
    if ((occupied_[bucket / 64] & bit) == 0) return;
    std::uint32_t last = first_[bucket];
    for (; entries_[last].next != kNone; last = entries_[last].next) f(entries_[last].path);
    f(entries_[last].path);
    entries_[last].next = free_;
    free_ = first_[bucket];
    occupied_[bucket / 64] &= ~bit;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  struct Entry {
    Path path;
    std::uint32_t next;  // of the same bucket, or of those without a path
  };

  std::array<std::uint64_t, kCount / 64> occupied_{};  // bit by bucket
  std::array<std::uint32_t, kCount> first_{};          // by bucket, if it is occupied: its first entry
  std::vector<Entry> entries_;
  std::uint32_t free_ = kNone;  // the first entry without a path
};

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
    assert(!(at < static_cast<double>(open_)));
    if (at < PathBuckets::kCount) {
      buckets_.add(static_cast<std::size_t>(at), path);
    } else {
      beyond_.push_back(path);
    }
  }

  /// Opens the first bucket that has paths, which may be the open one again. Returns whether there is one; if not, the
  /// queue is to be cleared before the next call.
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

}  // namespace meshhood::inline v0_1
