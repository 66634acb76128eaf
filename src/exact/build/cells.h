// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

#include "base/frame.h"
#include "base/kd_order.h"
#include "base/lists.h"
#include "exact/build/links.h"
#include "exact/layout.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// The number of vertices in a cell of the kd order. It is below the capacity of a leaf, so that small components of
/// neighboring cells fit in.
inline constexpr std::size_t kCellSize = 30;

/// The vertices in a kd order, of which every `kCellSize` consecutive ones are a cell. Within a cell they ascend. A
/// vertex of a cell has a slot, as it has in a leaf: 32 times its cell, plus its place in the cell.
struct Cells {
  RawVector<KdPoint> points;      // in kd order
  RawVector<std::uint32_t> slot;  // by vertex
  std::vector<VertexId> begin;    // by cell, and one more: its first point

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] unsigned size_of(std::size_t cell) const { return begin[cell + 1] - begin[cell]; }
  [[nodiscard]] const KdPoint& point(std::size_t cell, unsigned lane) const { return points[begin[cell] + lane]; }
};

/// frame  the frame of the positions
/// Throws Error{Cancelled}. O(#V log #V).
[[nodiscard]] Cells make_cells(const PositionsView& positions, const Frame& frame, TaskContext& task);

// A component with fewer vertices is merged into a neighbor with enough room, if there is one: two such components
// make one leaf.
inline constexpr unsigned kSmallComponent = 17;

/// A connected component of the mesh within a cell.
struct CellComponent {
  std::uint32_t cell;
  LaneMask lanes;
};

/// The components of all cells, numbered from cell to cell; the first of a cell is its largest.
struct CellComponents : Lists<CellComponent> {
  /// Returns the component that holds the vertex `lane` of a cell.
  [[nodiscard]] std::uint32_t at(std::size_t cell, unsigned lane) const {
    std::uint32_t component = offsets[cell];
    while ((elements[component].lanes >> lane & 1U) == 0) ++component;
    assert(component < offsets[cell + 1]);
    return component;
  }
};

/// Divides the cells into components. `links` are those of the cells. O(#V + #E).
[[nodiscard]] CellComponents split_cells(const Cells& cells, const Links& links, TaskContext& task);

/// The components that make a leaf together, by leaf.
struct MergedComponents : Lists<CellComponent> {
  std::vector<std::uint32_t> leaf_of;  // by component: its leaf
};

/// Merges small components into neighbors that have room, so that few leaves are small. A merged component is
/// connected, or consists of *crumbs*: small components of the whole mesh, which share leaves so that a cloud of points
/// does not take a leaf for each point. O(#V + edges of small components).
[[nodiscard]] MergedComponents merge_small(const CellComponents& components, const Links& links, TaskContext& task);

}  // namespace meshhood::inline v0_1
