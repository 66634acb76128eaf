// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

#include "base/frame.h"
#include "base/kd_order.h"
#include "exact/layout.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// The number of vertices in a cell of the kd order. Below the capacity of a leaf, so that small components of
/// neighboring cells fit in.
inline constexpr std::size_t kCellSize = 30;

/// The vertices in a kd order, of which every `kCellSize` consecutive ones are a cell. Within a cell they ascend.
/// A vertex of a cell has a slot, as it has in a leaf: 32 times its cell, plus its place in the cell.
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

}  // namespace meshhood::inline v0_1
