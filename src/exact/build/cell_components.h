// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/build/cells.h"
#include "exact/build/collect_rows.h"
#include "exact/build/links.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

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
  /// The component that holds the vertex `lane` of a cell.
  [[nodiscard]] std::uint32_t at(std::size_t cell, unsigned lane) const {
    std::uint32_t component = offsets[cell];
    while ((elements[component].lanes >> lane & 1U) == 0) ++component;
    assert(component < offsets[cell + 1]);
    return component;
  }
};

/// `links`: of the cells. O(#V + #E).
[[nodiscard]] CellComponents split_cells(const Cells& cells, const Links& links, TaskContext& task);

/// The components that make a leaf together, by leaf.
struct MergedComponents : Lists<CellComponent> {
  std::vector<std::uint32_t> leaf_of;  // by component: its leaf
};

/// Merges small components into neighbors that have room, so that few leaves are small. What is merged is connected,
/// or consists of *crumbs*: small components of the whole mesh, which share leaves so that a cloud of points does not
/// take a leaf for each point. O(#V + edges of small components).
[[nodiscard]] MergedComponents merge_small(const CellComponents& components, const Links& links, TaskContext& task);

}  // namespace meshhood::inline v0_1
