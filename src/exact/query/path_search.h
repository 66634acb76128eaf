// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/query/lane_filter.h"
#include "exact/query/local_graph.h"
#include "exact/query/path_queue.h"

namespace meshhood {

/// The algorithm of Dijkstra on the graph of an index, up to a radius.
class PathSearch {
 public:
  explicit PathSearch(const IndexView& index) : graph_(index) {}

  /// A vertex and its path distance.
  struct Found {
    double length;
    std::uint32_t vertex;  // in index order
  };

  /// Finds the vertices whose path distance from the vertex `slot` is at most `radius`, without passing `walls`.
  void run(std::uint32_t slot, double radius, const LaneFilter& walls);

  /// The vertices found by the last run, ascending by path distance, the first vertex first.
  [[nodiscard]] std::span<const Found> found() const { return found_; }

 private:
  void start(std::uint32_t slot, const LaneFilter& walls);
  void follow_edges(const Path& path, const LaneFilter& walls);
  void add_met_leaves(const LaneFilter& walls);

  LocalGraph graph_;
  std::vector<double> lengths_;  // by local slot: the least length so far
  double unreached_ = 0;         // the length of vertices without a path: the least one beyond the radius
  PathQueue queue_;              // holds longer paths to the same vertices too
  std::vector<Found> found_;
};

}  // namespace meshhood
