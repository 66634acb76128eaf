// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"

#include "base/parallel.h"
#include "exact/build/kd_order.h"

namespace meshhood {

// The number of vertices in a cell of the kd order. Below the capacity of a leaf, so that small components of
// neighboring cells fit in.
inline constexpr std::size_t kCellSize = 30;

// A component with fewer vertices is merged into a neighbor with enough room, if there is one: two such components
// make one leaf.
inline constexpr std::uint32_t kSmallComponent = 17;

/// The graph of the mesh with its vertices numbered in kd order, where each `kCellSize` consecutive ones form a cell.
class CellGraph {
 public:
  /// `points` are all vertices, in kd order. They and `adjacency` are borrowed.
  CellGraph(std::span<const KdPoint> points, const AdjacencyView& adjacency, TaskContext& task);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] std::size_t cells() const { return (size() + kCellSize - 1) / kCellSize; }
  [[nodiscard]] std::size_t begin(std::size_t cell) const { return std::min(cell * kCellSize, size()); }
  [[nodiscard]] std::size_t end(std::size_t cell) const { return begin(cell + 1); }

  template <class F>
  void for_each_neighbor(std::size_t point, F&& f) const {
    for (const VertexId w : adjacency_[points_[point].id]) f(std::size_t{number_[w]});
  }

 private:
  std::span<const KdPoint> points_;
  AdjacencyView adjacency_;
  std::vector<std::uint32_t> number_;  // by vertex: its position in kd order
};

/// The connected components of the mesh within each cell, numbered from cell to cell.
struct CellComponents {
  std::vector<std::uint32_t> first;  // by cell, and one more: its first component, which is its largest
  std::vector<std::uint32_t> of;     // by vertex in kd order
  std::vector<std::uint32_t> size;   // by component
};

/// O(#V + #E).
[[nodiscard]] CellComponents split_cells(const CellGraph& graph, TaskContext& task);

/// Merges small components into neighbors that have room, so that few leaves are small. What is merged is connected,
/// or consists of *crumbs*: small components of the whole mesh, which share leaves so that a cloud of points does not
/// take a leaf for each point. A component that has been merged into another keeps its number, and has size 0. O(#V +
/// edges of small components).
void merge_small(const CellGraph& graph, CellComponents& components);

}  // namespace meshhood
