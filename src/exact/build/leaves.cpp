// SPDX-License-Identifier: MIT
// A kd tree divides space into cells of 30 vertices. The mesh may pass through a cell in several connected components;
// each becomes a leaf of its own if it is large enough, else it is merged into a neighbouring leaf that has room.
#include "exact/build/leaves.h"

#include <array>
#include <span>
#include <string>

#include "meshhood/error.h"

#include "exact/build/cell_components.h"
#include "exact/build/kd_order.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

// Enough work to be worth a thread's while.
constexpr std::size_t kVerticesPerTask = 4096;

std::vector<KdPoint> make_points(const PositionsView& positions, const Frame& frame, TaskContext& task) {
  return positions.visit([&](const auto& xyz) {
    std::vector<KdPoint> points(xyz.size());
    task.parallel_for(points.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const FramePoint p = frame.round(point(xyz, v));
        points[v] = {{p.x, p.y, p.z}, static_cast<std::uint32_t>(v)};
      }
    });
    return points;
  });
}

/// The mean of each component that has vertices, with the number of the component, in the order of the leaves.
std::vector<KdPoint> order_components(std::span<const KdPoint> points, const CellComponents& components) {
  std::vector<std::array<double, 3>> sum(components.size.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[components.of[i]][axis] += static_cast<double>(points[i].at[axis]);
    }
  }
  std::vector<KdPoint> means;
  for (std::uint32_t c = 0; c < sum.size(); ++c) {
    if (components.size[c] == 0) continue;
    const auto mean = [&](std::size_t axis) { return static_cast<float>(sum[c][axis] / components.size[c]); };
    means.push_back({{mean(0), mean(1), mean(2)}, c});
  }
  kd_order_nested(means, kFanOut);  // mutant: leaves-in-any-order
  return means;
}

/// Gives each vertex the next free lane of its leaf, which `slot` holds at first. In the order of the caller's
/// vertices, so that neighbours in a leaf stay neighbours.
void number_vertices(LeafPartition& leaves) {
  std::vector<std::uint8_t> filled(leaves.leaf_begin.size() - 1, 0);
  for (std::size_t v = 0; v < leaves.slot.size(); ++v) {
    const LeafId leaf = leaves.slot[v];
    const std::uint32_t lane = filled[leaf]++;
    leaves.slot[v] = leaf * kLeafCapacity + lane;                                   // mutant: slot-without-lane
    leaves.permutation[leaves.leaf_begin[leaf] + lane] = static_cast<VertexId>(v);  // mutant: vertex-listed-twice
  }
}

}  // namespace

void check_leaf_count(std::size_t leaves) {
  if (leaves <= kMaxLeaves) return;  // mutant: largest-leaf-count-refused
  raise(ErrorCode::TooLarge,
        std::to_string(leaves) + " leaves in the index, but the limit is " + std::to_string(kMaxLeaves));
}

LeafPartition make_leaves(const GraphView& graph, const Frame& frame, TaskContext& task) {
  std::vector<KdPoint> points = make_points(graph.positions, frame, task);
  kd_order(points, kCellSize, task);
  const CellGraph cells(points, graph.adjacency, task);
  CellComponents components = split_cells(cells, task);
  merge_small(cells, components);
  const std::vector<KdPoint> order = order_components(points, components);
  check_leaf_count(order.size());

  LeafPartition result;
  result.slot.resize(points.size());
  result.permutation.resize(points.size());
  result.leaf_begin.assign(order.size() + 1, 0);
  std::vector<LeafId> leaf_of_component(components.size.size());
  for (std::size_t leaf = 0; leaf < order.size(); ++leaf) {
    const std::uint32_t component = order[leaf].id;
    leaf_of_component[component] = static_cast<LeafId>(leaf);
    result.leaf_begin[leaf + 1] = static_cast<VertexId>(result.leaf_begin[leaf] + components.size[component]);
  }
  task.parallel_for(points.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.slot[points[i].id] = leaf_of_component[components.of[i]];
  });
  number_vertices(result);
  return result;
}

}  // namespace meshhood
