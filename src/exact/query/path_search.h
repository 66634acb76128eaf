// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/query/path_order.h"
#include "exact/query/path_queue.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {

/// The shortest paths along the edges from one or more vertices, up to a radius, by label correction in buckets
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

  /// O(#V), and for the first search of an index O(#V + #E): its weighted graph is made.
  PathSearch(const IndexView& index, KeptGraph& graph);

  /// Finds the vertices whose path distance from the vertex `start`, in index order, is at most `radius`, without
  /// passing walls.
  void run(std::uint32_t start, double radius) {
    const Path path{0, start};
    run(std::span(&path, 1), radius, [](std::span<const Path>) { return false; });
  }

  /// The same from the ends of some paths, of which one may be named more than once: the path to a vertex is then the
  /// shortest of those that continue one of them. Ends as soon as `is_enough(paths)` returns true: it is called for the
  /// paths that were found since the last call. All paths that are shorter than one of these have then been found.
  template <class IsEnough>
  void run(std::span<const Path> starts, double radius, IsEnough&& is_enough) {
    begin(starts, radius);
    while (queue_.open()) {
      const std::size_t before = found_.size();
      search_open_bucket();
      if (!is_enough(std::span<const Path>(found_).subspan(before))) continue;
      abandon();
      break;
    }
    is_complete_ = true;
  }

  /// The paths found by the last run: from one vertex, that to itself first, the others in no stated order, but hardly
  /// one after another that is longer by an eighth of an edge.
  [[nodiscard]] std::span<const Path> found() const { return found_; }

  /// The same, ascending by length, then by vertex in index order; from one vertex, after that to it.
  [[nodiscard]] std::span<const Path> found_in_order();

  /// How many times the last run followed the edges of a vertex.
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
  bool has_one_start_ = true;
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
