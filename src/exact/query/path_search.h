// SPDX-License-Identifier: MIT
// Shortest paths along edges from a vertex: the queue of paths in buckets, the search, and the order of its result.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/weighted_graph.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

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

  /// Returns the first bucket from `bucket` on that has paths, or `kCount`.
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
  /// Returns the bucket of a length, with a fraction. It never decreases if the length grows.
  [[nodiscard]] double position(double length) const { return (length - base_) * scale_; }
  void begin_window();

  double width_ = 0;  // the least width of a bucket
  double base_ = 0;   // where the window begins
  double scale_ = 0;  // buckets in a unit of length
  PathBuckets buckets_;
  std::vector<Path> beyond_;  // those beyond the window
  std::size_t open_ = 0;      // the number of the open bucket
};

[[nodiscard]] inline bool comes_before(const Path& a, const Path& b) {
  return a.length != b.length ? a.length < b.length : a.end < b.end;
}

/// Sorts paths by length, then by their ends: few by comparing each with each, more by counting those of equal
/// intervals of length, of which there are as many as paths. Takes linear time if the lengths are spread about evenly,
/// as those of shortest paths are, and O(n log n) otherwise.
class PathOrder {
 public:
  /// Returns the paths in order, valid until the next call. Their lengths are finite, and not negative.
  [[nodiscard]] std::span<const Path> sorted(std::span<const Path> paths);

  /// Adds one more path, by a step for each path that comes before it.
  [[nodiscard]] std::span<const Path> sorted(const Path& one, std::span<const Path> paths);

 private:
  void sort_by_comparison(std::span<const Path> paths, std::span<Path> result) const;
  void sort_by_intervals(std::span<const Path> paths, std::span<Path> result);

  const Kernels* kernels_ = &kernels(best_isa());
  std::vector<Path> sorted_;
  std::vector<std::uint32_t> ends_;  // by interval
};

/// Finds the shortest paths along the edges from one or more vertices, up to a radius, by label correction in buckets
/// (delta-stepping: Meyer and Sanders 2003).
///
/// The paths of a bucket are followed in any order. A vertex whose path becomes shorter in the bucket is followed again
/// in the next *round*. This finds the same lengths as the algorithm of Dijkstra, to the last bit. When nothing is left
/// to follow, no edge makes a path shorter. So the length at a vertex is that of a path to it, and at most that of any
/// other path, by induction over the edges of that path: the rounded sum never decreases if a summand grows.
///
/// The lengths of a bucket are final when it is empty, so each vertex is followed in one bucket only. After `kRounds`
/// rounds the rest of a bucket is followed in order of length, each vertex once. So no lengths of edges, be they zero
/// or of very different size, cause more than `kRounds + 1` steps for a vertex.
class PathSearch {
 public:
  static constexpr int kRounds = 4;

  /// Takes O(#V), and for the first search of an index O(#V + #E), because its weighted graph is made.
  PathSearch(const IndexView& index, KeptGraph& graph);

  /// Finds the vertices whose path distance from the vertex `start`, in index order, is at most `radius`, without
  /// passing walls.
  void run(std::uint32_t start, double radius) {
    const Path path{0, start};
    run(std::span(&path, 1), radius, [](std::span<const Path>) { return false; });
  }

  /// Does the same from the ends of some paths, of which one may be named more than once: the path to a vertex is then
  /// the shortest of those that continue one of them. Ends as soon as `on_found(paths)` returns true: it is called for
  /// the paths that were found since the last call. All paths that are shorter than one of these have then been found.
  template <class OnFound>
  void run(std::span<const Path> starts, double radius, OnFound&& on_found) {
    begin(starts, radius);
    while (queue_.open()) {
      const std::size_t before = found_.size();
      search_open_bucket();
      if (!on_found(std::span<const Path>(found_).subspan(before))) continue;
      abandon();
      break;
    }
    is_complete_ = true;
  }

  /// Returns the paths found by the last run: from one vertex, that to itself first, the others in no stated order, but
  /// hardly one after another that is longer by an eighth of an edge.
  [[nodiscard]] std::span<const Path> found() const { return found_; }

  /// Returns them ascending by length, then by vertex in index order.
  [[nodiscard]] std::span<const Path> found_in_order();

  /// Returns how many times the last run followed the edges of a vertex.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  void begin(std::span<const Path> starts, double radius);
  void abandon();
  void forget();
  [[nodiscard]] double mean_length_near(std::uint32_t vertex) const;
  void search_open_bucket();
  [[nodiscard]] bool take_round();
  void follow_round();
  void follow_in_order();
  void follow(const Path& path);
  void push_shorter();
  void prefetch_edges(std::uint32_t vertex) const;
  [[nodiscard]] bool is_least(const Path& path) const { return path.length == lengths_[path.end]; }

  const IndexView* index_;
  const WeightedGraph* graph_;
  const Adjacency* edges_;  // of the graph
  double radius_ = 0;
  std::vector<double> lengths_;      // by vertex: of the shortest path so far, also beyond the radius
  std::vector<std::uint32_t> left_;  // vertices with such a length that are not found: beyond the radius, or walls
  bool is_complete_ = true;          // else the last run threw
  PathQueue queue_;                  // holds longer paths to the same vertices too
  std::vector<Path> round_;          // the first `round_count_`: the paths of the open bucket that are followed now
  std::size_t round_count_ = 0;
  std::vector<Path> shorter_;  // the first `shorter_count_`: found since, not in the queue yet
  std::size_t shorter_count_ = 0;
  std::vector<Path> found_;  // in the order of the buckets
  std::size_t steps_ = 0;
  PathOrder order_;
};

}  // namespace meshhood::inline v0_1
