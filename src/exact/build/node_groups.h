// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/lists.h"
#include "exact/build/collect_rows.h"
#include "shared/distance.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// A rough bounding sphere of a node, by which nodes are grouped. The tree stores better ones.
struct NodeBall {
  Point center;
  double radius;
};

/// The nodes of one level while the tree is built, and the links between them.
struct NodeGraph {
  std::vector<NodeBall> balls;     // by node
  Lists<std::uint32_t> neighbors;  // by node, ascending

  [[nodiscard]] std::size_t size() const { return balls.size(); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t node) const { return neighbors[node]; }
};

/// A graph of `size` nodes. `ball_at(node)` is the ball of a node; `append(node, out)` appends its neighbors, in any
/// order and any number of times.
template <class BallAt, class Append>
NodeGraph make_graph(std::size_t size, BallAt&& ball_at, Append&& append, TaskContext& task) {
  NodeGraph graph;
  graph.balls.resize(size);
  graph.neighbors = collect_rows<std::uint32_t>(size, task, [&](std::size_t node, std::vector<std::uint32_t>& out) {
    graph.balls[node] = ball_at(node);
    const auto row = static_cast<std::ptrdiff_t>(out.size());
    append(node, out);
    std::sort(out.begin() + row, out.end());
    out.erase(std::unique(out.begin() + row, out.end()), out.end());
  });
  return graph;
}

/// Sets of up to eight nodes.
using NodeGroups = Lists<std::uint32_t>;

/// The sphere around the mean of the centers of `a` and `b` that holds the spheres of all these nodes.
[[nodiscard]] NodeBall ball_of(const NodeGraph& graph, std::span<const std::uint32_t> a,
                               std::span<const std::uint32_t> b = {});

/// The level above: each group becomes a node. Nodes that are in no group have no links.
[[nodiscard]] NodeGraph contract(const NodeGraph& graph, const NodeGroups& groups, TaskContext& task);

}  // namespace meshhood::inline v0_1
