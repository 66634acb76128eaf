// SPDX-License-Identifier: MIT
#include "exact/build/cells.h"

#include <algorithm>

namespace meshhood::inline v0_1 {
namespace {

// Enough that passing them to a thread costs little.
constexpr std::size_t kPointGrain = 2048;
constexpr std::size_t kCellGrain = 64;

RawVector<KdPoint> make_points(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  return positions.visit([&](const auto& xyz) {
    RawVector<KdPoint> points(xyz.size());
    task.parallel_for(points.size(), kPointGrain, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) points[v] = kd_point(frame.to_frame(point(xyz, v)), v);
    });
    return points;
  });
}

}  // namespace

Cells make_cells(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  Cells cells;
  cells.points = make_points(positions, frame, task);
  kd_order(cells.points, kCellSize, task);
  const std::size_t vertices = cells.points.size();
  cells.slot.resize(vertices);
  cells.begin.resize((vertices + kCellSize - 1) / kCellSize + 1);
  task.parallel_for(cells.begin.size(), kCellGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::size_t first = std::min(cell * kCellSize, vertices);
      const std::size_t last = std::min(first + kCellSize, vertices);
      cells.begin[cell] = static_cast<VertexId>(first);
      for (std::size_t i = first; i < last; ++i) {
        cells.slot[cells.points[i].id] = static_cast<std::uint32_t>(cell * kLeafCapacity + (i - first));
      }
    }
  });
  return cells;
}

}  // namespace meshhood::inline v0_1
