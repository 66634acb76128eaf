// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/query/lane_filter.h"
#include "exact/query/radix_heap.h"

namespace meshhood {

/// The algorithm of Dijkstra on the graph of an index, up to a radius. The lengths of paths are kept in index order, so
/// that those of near vertices are near in memory.
class PathSearch {
 public:
  explicit PathSearch(const IndexView& index);

  /// A vertex and its path distance.
  struct Found {
    double length;
    std::uint32_t slot;
    std::uint32_t vertex;  // in index order
  };

  /// Finds the vertices whose path distance from the vertex `slot` is at most `radius`, without passing `walls`.
  void run(std::uint32_t slot, double radius, const LaneFilter& walls);

  /// The vertices found by the last run, ascending by path distance, the first vertex first.
  [[nodiscard]] std::span<const Found> found() const { return found_; }

 private:
  template <class Real>
  void run(std::span<const Real> xyz);
  template <class Real>
  void follow_edges(const Found& from, std::span<const Real> xyz);
  void open(LeafId leaf);
  void offer(const Found& path);

  const IndexView* index_;
  const LaneFilter* walls_ = nullptr;
  std::vector<std::uint32_t> runs_;  // by leaf: the number of the run that made its vertices ready for paths
  std::vector<double> lengths_;      // in index order: the least length so far, if the leaf is of this run
  double unreached_ = 0;             // the length of vertices without a path: the least one beyond the radius
  RadixHeap<Found> queue_;           // holds longer paths to the same vertices too
  std::vector<Found> found_;
  std::uint32_t run_ = 0;
};

}  // namespace meshhood
