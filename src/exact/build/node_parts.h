// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/kd_order.h"
#include "base/lists.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "simd/node_group.h"

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

/// Makes a graph of `size` nodes. `ball_at(node)` is the ball of a node; `append(node, out)` appends its neighbors, in
/// any order and any number of times.
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

/// Returns the sphere around the mean of the centers of `a` and `b` that holds the spheres of all these nodes.
[[nodiscard]] NodeBall ball_of(const NodeGraph& graph, std::span<const std::uint32_t> a,
                               std::span<const std::uint32_t> b = {});

/// Returns the level above: each group becomes a node. Nodes that are in no group have no links.
[[nodiscard]] NodeGraph contract(const NodeGraph& graph, const NodeGroups& groups, TaskContext& task);

/// Divides the nodes of one level that have links into connected parts of up to eight, while groups are made of them.
class NodeParts {
 public:
  static constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();

  explicit NodeParts(const NodeGraph& graph) : graph_(&graph), part_of_(graph.size(), kNoPart) {}

  /// Adds a part of `nodes`, which are in no part yet.
  void add(std::span<const std::uint32_t> nodes);

  /// Makes `node` the last node of `part`, which has room for it.
  void move(std::uint32_t node, std::uint32_t part);

  /// Returns the number of parts, with those that have lost all their nodes.
  [[nodiscard]] std::size_t size() const { return parts_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t part) const { return parts_[part].nodes(); }
  [[nodiscard]] std::uint32_t part_of(std::uint32_t node) const { return part_of_[node]; }

  /// Returns the part, other than their own, that is linked with one of `nodes`, has room for all of them, and then has
  /// the smallest sphere; the first of several; `kNoPart` if none has a sphere of at most the radius `limit`.
  [[nodiscard]] std::uint32_t best_part_for(std::span<const std::uint32_t> nodes, double limit) const;

  /// Returns the mean radius of the parts of eight nodes; infinite if there is none.
  [[nodiscard]] double mean_full_radius() const;

  /// Returns the share of the places for nodes that are taken.
  [[nodiscard]] double fill() const;

  /// Returns the parts that have nodes.
  [[nodiscard]] NodeGroups groups() const;

 private:
  class Part {
   public:
    void add(std::uint32_t node) {
      assert(size_ < kFanOut);
      nodes_[size_++] = node;
    }
    void remove(std::uint32_t node);
    [[nodiscard]] std::span<const std::uint32_t> nodes() const { return std::span(nodes_).first(size_); }

   private:
    std::array<std::uint32_t, kFanOut> nodes_{};
    std::size_t size_ = 0;
  };

  const NodeGraph* graph_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> part_of_;  // by node
};

/// Divides nodes into parts that lie close together and are connected by links: the connected parts of the cells of a
/// kd order, of which small ones are joined. O(links).
///
/// order  the nodes of `graph` that have links, in a kd order of eight
[[nodiscard]] NodeParts connected_parts(const NodeGraph& graph, std::span<const KdPoint> order);

/// Dissolves small parts: each of their nodes moves to another part that it is linked with, so all parts stay
/// connected. A part whose nodes do not all find room stays as it was. O(links).
///
/// A place that no node takes needs as much memory as a node. On closely folded surfaces, where most cells of a kd
/// order are cut, a fifth of the places would stay empty.
void dissolve_small_parts(NodeParts& parts);

}  // namespace meshhood::inline v0_1
