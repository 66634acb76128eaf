// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/build/collect_rows.h"
#include "shared/distance.h"
#include "shared/parallel.h"

namespace meshhood {

/// A rough bounding sphere of a node, by which nodes are grouped. The tree stores better ones.
struct NodeBall {
  Point center;
  double radius;
};

/// The nodes of one level while the tree is built, and the links between them.
struct NodeGraph {
  std::vector<NodeBall> balls;             // by node
  CollectedRows<std::uint32_t> neighbors;  // by node, ascending

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
class NodeGroups {
 public:
  void add(std::span<const std::uint32_t> nodes) {
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    begin_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }
  [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t group) const {
    assert(group < size());
    return std::span(nodes_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::uint32_t> begin_{0};
  std::vector<std::uint32_t> nodes_;
};

/// The sphere around the mean of the centers of `a` and `b` that holds the spheres of all these nodes.
[[nodiscard]] NodeBall ball_of(const NodeGraph& graph, std::span<const std::uint32_t> a,
                               std::span<const std::uint32_t> b = {});

/// The level above: each group becomes a node. Nodes that are in no group have no links.
[[nodiscard]] NodeGraph contract(const NodeGraph& graph, const NodeGroups& groups, TaskContext& task);

}  // namespace meshhood
