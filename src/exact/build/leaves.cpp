// SPDX-License-Identifier: MIT
// A kd tree divides space into cells of 30 vertices. The mesh may pass through a cell in several connected components;
// each becomes a leaf of its own if it is large enough, else it is merged into a neighboring leaf that has room.
// The leaves are then grouped by their links, which decides their order.
#include "exact/build/leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "base/vector.h"
#include "exact/build/cell_components.h"
#include "exact/build/kd_order.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

// Enough work for the cost of starting a thread.
constexpr std::size_t kVerticesPerTask = 4096;

Point center_of(const KdPoint& p) {
  return {static_cast<double>(p.at[0]), static_cast<double>(p.at[1]), static_cast<double>(p.at[2])};
}

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

/// The number of each component that has vertices, counted without the others.
std::vector<std::uint32_t> number_components(const CellComponents& components) {
  std::vector<std::uint32_t> number(components.size.size());
  std::uint32_t count = 0;
  for (std::size_t c = 0; c < number.size(); ++c) number[c] = components.size[c] > 0 ? count++ : count;
  return number;
}

/// The mean of the vertices of each leaf, and the distance of the farthest from it. `leaf_of`: by point.
std::vector<NodeBall> measure_leaves(std::span<const KdPoint> points, std::span<const std::uint32_t> leaf_of,
                                     std::span<const std::uint32_t> sizes) {
  std::vector<NodeBall> balls(sizes.size(), NodeBall{{0, 0, 0}, 0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    balls[leaf_of[i]].center = balls[leaf_of[i]].center + center_of(points[i]);
  }
  for (std::size_t leaf = 0; leaf < sizes.size(); ++leaf) {
    balls[leaf].center = 1 / static_cast<double>(sizes[leaf]) * balls[leaf].center;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    NodeBall& ball = balls[leaf_of[i]];
    ball.radius = std::max(ball.radius, squared_distance(ball.center, center_of(points[i])));
  }
  for (NodeBall& ball : balls) ball.radius = std::sqrt(ball.radius);
  return balls;
}

using LeafPair = std::uint64_t;

/// Every pair of leaves that an edge joins, in both directions: 2^32 times the first, plus the second.
std::vector<LeafPair> find_pairs(const CellGraph& cells, std::span<const std::uint32_t> leaf_of, TaskContext& task) {
  std::vector<std::vector<LeafPair>> runs((cells.size() + kVerticesPerTask - 1) / kVerticesPerTask);
  task.parallel_for(cells.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    std::vector<LeafPair>& pairs = runs[begin / kVerticesPerTask];
    // Most edges between two leaves follow each other closely, and need not be sorted. No leaf is joined with itself.
    std::array<LeafPair, 64> recent{};
    for (std::size_t i = begin; i < end; ++i) {
      cells.for_each_neighbor(i, [&](std::size_t other) {
        if (leaf_of[i] == leaf_of[other]) return;
        const LeafPair pair = LeafPair{leaf_of[i]} << 32U | leaf_of[other];
        LeafPair& last = recent[(7 * std::size_t{leaf_of[i]} + leaf_of[other]) % recent.size()];
        if (std::exchange(last, pair) != pair) pairs.push_back(pair);
      });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  });
  std::vector<LeafPair> all;
  for (const std::vector<LeafPair>& run : runs) all.insert(all.end(), run.begin(), run.end());
  // Nearly in order: the leaves of a run mostly follow those of the run before.
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

NodeGraph graph_of_leaves(std::vector<NodeBall> balls, std::span<const LeafPair> pairs) {
  NodeGraph graph;
  graph.balls = std::move(balls);
  graph.offsets.assign(graph.balls.size() + 1, 0);
  for (const LeafPair pair : pairs) {
    ++graph.offsets[(pair >> 32U) + 1];
    graph.neighbors.push_back(static_cast<std::uint32_t>(pair));
  }
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  return graph;
}

/// Gives each vertex the next free lane of its leaf, which `slot` holds at first. In the order of the caller's
/// vertices, so that neighbors in a leaf stay neighbors.
void number_vertices(LeafPartition& leaves) {
  std::vector<std::uint8_t> filled(leaves.leaf_begin.size() - 1, 0);
  for (std::size_t v = 0; v < leaves.slot.size(); ++v) {
    const LeafId leaf = leaves.slot[v];
    const std::uint32_t lane = filled[leaf]++;
    leaves.slot[v] = leaf * kLeafCapacity + lane;
    leaves.permutation[leaves.leaf_begin[leaf] + lane] = static_cast<VertexId>(v);
  }
}

}  // namespace

void check_leaf_count(std::size_t leaves) {
  if (leaves <= kMaxLeaves) return;
  raise(ErrorCode::TooLarge,
        std::to_string(leaves) + " leaves in the index, but the limit is " + std::to_string(kMaxLeaves));
}

LeafPartition make_leaves(const GraphView& graph, const Frame& frame, TaskContext& task) {
  std::vector<KdPoint> points = make_points(graph.positions, frame, task);
  kd_order(points, kCellSize, task);
  const CellGraph cells(points, graph.adjacency, task);
  CellComponents components = split_cells(cells, task);
  merge_small(cells, components);
  const std::vector<std::uint32_t> number = number_components(components);
  std::vector<std::uint32_t> leaf_of = std::move(components.of);
  for (std::uint32_t& leaf : leaf_of) leaf = number[leaf];
  std::vector<std::uint32_t> sizes = std::move(components.size);
  std::erase(sizes, 0U);

  LeafPartition result;
  result.forest =
      make_forest(graph_of_leaves(measure_leaves(points, leaf_of, sizes), find_pairs(cells, leaf_of, task)));
  const std::span<const std::uint32_t> order = result.forest.leaves;
  check_leaf_count(order.size());
  result.slot.resize(points.size());
  result.permutation.resize(points.size());
  result.leaf_begin.assign(order.size() + 1, 0);
  std::vector<LeafId> place_of(sizes.size());
  for (std::size_t leaf = 0; leaf < order.size(); ++leaf) {
    result.leaf_begin[leaf + 1] = result.leaf_begin[leaf];
    if (order[leaf] == kNoNode) continue;
    place_of[order[leaf]] = static_cast<LeafId>(leaf);
    result.leaf_begin[leaf + 1] += static_cast<VertexId>(sizes[order[leaf]]);
  }
  task.parallel_for(points.size(), kVerticesPerTask, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.slot[points[i].id] = place_of[leaf_of[i]];
  });
  number_vertices(result);
  return result;
}

}  // namespace meshhood
