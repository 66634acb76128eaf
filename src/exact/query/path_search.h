// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/query/lane_filter.h"

namespace meshhood {

/// The algorithm of Dijkstra on the graph of an index, up to a radius. The lengths of paths are kept in index order, so
/// that those of near vertices are near in memory. The lengths of the edges of a leaf are computed together, when its
/// first vertex is found.
class PathSearch {
 public:
  explicit PathSearch(const IndexView& index);

  /// A vertex and its path distance.
  struct Found {
    double length;
    std::uint32_t slot;

    friend bool operator>(const Found& a, const Found& b) {
      return a.length != b.length ? a.length > b.length : a.slot > b.slot;
    }
  };

  /// Finds the vertices whose path distance from the vertex `slot` is at most `radius`, without passing `walls`.
  void run(std::uint32_t slot, double radius, const LaneFilter& walls);

  /// The vertices found by the last run, ascending by path distance, then by slot.
  [[nodiscard]] std::span<const Found> found() const { return found_; }

 private:
  /// The state of a leaf in one run.
  struct State {
    std::uint32_t number = 0;  // the state is valid for this run only
    LaneMask settled = 0;      // found, or walls
    bool has_arcs = false;
    std::size_t first_row = 0;  // in `rows_`
  };

  /// An edge from a vertex, as its search follows it.
  struct Arc {
    double length;
    std::uint32_t to;  // a slot
  };

  using RowBegins = std::array<std::size_t, kLeafCapacity + 1>;

  [[nodiscard]] std::span<const Arc> arcs_of(std::uint32_t slot);
  [[nodiscard]] RowBegins row_begins(LeafId leaf) const;
  template <class Real>
  void add_arcs(std::span<const Real> xyz, LeafId leaf, RowBegins ends);
  State& state_of(LeafId leaf);
  void offer(const Found& path, double radius);

  const IndexView* index_;
  const LaneFilter* walls_ = nullptr;
  std::vector<State> states_;      // by leaf
  std::vector<double> lengths_;    // in index order: the least length so far; valid where the state of the leaf is
  std::vector<std::size_t> rows_;  // of leaves with arcs: where those of each lane begin in `arcs_`, and their end
  std::vector<Arc> arcs_;
  std::vector<Found> queue_;  // a heap, the shortest path first; holds longer paths to the same vertices too
  std::vector<Found> found_;
  std::uint32_t number_ = 0;
};

}  // namespace meshhood
