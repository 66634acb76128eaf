// SPDX-License-Identifier: MIT
#include "exact/build/node_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "base/vector.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();

}  // namespace

NodeBall ball_of(const NodeGraph& graph, std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  Point sum{0, 0, 0};
  for (const auto nodes : {a, b}) {
    for (const std::uint32_t node : nodes) sum = sum + graph.balls[node].center;
  }
  NodeBall ball{1 / static_cast<double>(a.size() + b.size()) * sum, 0};
  for (const auto nodes : {a, b}) {
    for (const std::uint32_t node : nodes) {
      const double distance = std::sqrt(squared_distance(graph.balls[node].center, ball.center));
      ball.radius = std::max(ball.radius, distance + graph.balls[node].radius);
    }
  }
  return ball;
}

NodeGraph contract(const NodeGraph& graph, const NodeGroups& groups, TaskContext& task) {
  std::vector<std::uint32_t> group_of(graph.size(), kUnset);
  for (std::uint32_t group = 0; group < groups.size(); ++group) {
    for (const std::uint32_t node : groups[group]) group_of[node] = group;
  }
  const auto append_neighbors = [&](std::size_t group, std::vector<std::uint32_t>& out) {
    for (const std::uint32_t node : groups[group]) {
      for (const std::uint32_t other : graph[node]) {
        if (group_of[other] != group) out.push_back(group_of[other]);
      }
    }
  };
  return make_graph(
      groups.size(), [&](std::size_t group) { return ball_of(graph, groups[group]); }, append_neighbors, task);
}

void NodeParts::Part::remove(std::uint32_t node) {
  std::uint32_t* const end = nodes_.data() + size_;
  size_ = static_cast<std::size_t>(std::remove(nodes_.data(), end, node) - nodes_.data());
}

void NodeParts::add(std::span<const std::uint32_t> nodes) {
  for (const std::uint32_t node : nodes) {
    assert(part_of_[node] == kNoPart);
    part_of_[node] = static_cast<std::uint32_t>(parts_.size());
  }
  Part& part = parts_.emplace_back();
  for (const std::uint32_t node : nodes) part.add(node);
}

void NodeParts::move(std::uint32_t node, std::uint32_t part) {
  assert(part_of_[node] != kNoPart);
  parts_[part_of_[node]].remove(node);
  parts_[part].add(node);
  part_of_[node] = part;
}

std::uint32_t NodeParts::best_part_for(std::span<const std::uint32_t> nodes, double limit) const {
  std::uint32_t best = kNoPart;
  double least = limit;
  for (const std::uint32_t node : nodes) {
    for (const std::uint32_t other : (*graph_)[node]) {
      const std::uint32_t part = part_of_[other];
      if (part == part_of_[node] || part == best || parts_[part].nodes().size() + nodes.size() > kFanOut) continue;
      const double radius = ball_of(*graph_, nodes, parts_[part].nodes()).radius;
      if (radius > least || (radius == least && part > best)) continue;
      least = radius;
      best = part;
    }
  }
  return best;
}

double NodeParts::mean_full_radius() const {
  double sum = 0;
  std::size_t count = 0;
  for (const Part& part : parts_) {
    if (part.nodes().size() < kFanOut) continue;
    sum += ball_of(*graph_, part.nodes()).radius;
    ++count;
  }
  return count == 0 ? kInfinity : sum / static_cast<double>(count);
}

double NodeParts::fill() const {
  std::size_t nodes = 0;
  std::size_t places = 0;
  for (const Part& part : parts_) {
    nodes += part.nodes().size();
    places += part.nodes().empty() ? 0 : kFanOut;
  }
  return places == 0 ? 1 : static_cast<double>(nodes) / static_cast<double>(places);
}

NodeGroups NodeParts::groups() const {
  NodeGroups groups;
  for (const Part& part : parts_) {
    if (!part.nodes().empty()) groups.add(part.nodes());
  }
  return groups;
}

namespace {

constexpr std::uint32_t kNoPlace = std::numeric_limits<std::uint32_t>::max();

/// Divides cells of eight nodes into their connected parts.
class CellSplitter {
 public:
  CellSplitter(const NodeGraph& graph, std::span<const KdPoint> order)
      : graph_(&graph), order_(order), place_(graph.size(), kNoPlace) {
    for (std::size_t i = 0; i < order.size(); ++i) place_[order[i].id] = static_cast<std::uint32_t>(i);
  }

  /// Adds the parts of the cell that begins at a place of the order.
  void split(std::size_t begin, NodeParts& parts) {
    const auto size = static_cast<unsigned>(std::min<std::size_t>(kFanOut, order_.size() - begin));
    const std::array<NodeSet, kFanOut> linked = links_within(begin, size);
    for (unsigned left = first_nodes(size); left != 0;) {
      const NodeSet found = reachable_nodes(linked, static_cast<NodeSet>(left & -left), first_nodes(size));
      left &= ~unsigned{found};
      nodes_.clear();
      for_each_node(found, [&](unsigned i) { nodes_.push_back(order_[begin + i].id); });
      parts.add(nodes_);
    }
  }

 private:
  [[nodiscard]] std::array<NodeSet, kFanOut> links_within(std::size_t begin, unsigned size) const {
    std::array<NodeSet, kFanOut> linked{};
    for (unsigned i = 0; i < size; ++i) {
      for (const std::uint32_t other : (*graph_)[order_[begin + i].id]) {
        // A place before the cell wraps around to a large number.
        const std::size_t place = std::size_t{place_[other]} - begin;
        if (place < size) linked[i] |= node_at(static_cast<unsigned>(place));
      }
    }
    return linked;
  }

  const NodeGraph* graph_;
  std::span<const KdPoint> order_;
  std::vector<std::uint32_t> place_;  // by node: its place in the order
  std::vector<std::uint32_t> nodes_;
};

/// Joins small parts with linked ones that have room, the smallest first: a single node has the fewest parts to join.
void join_small_parts(NodeParts& parts) {
  // The largest radius of a joined part, divided by the mean of full ones. Chosen: joining a part of one or two nodes
  // gains more.
  constexpr double kSmallStretch = 2.5;
  constexpr double kLargeStretch = 1.5;
  const double full = parts.mean_full_radius();
  std::vector<std::uint32_t> nodes;
  for (std::size_t size = 1; size <= kFanOut / 2; ++size) {
    const double limit = (size <= 2 ? kSmallStretch : kLargeStretch) * full;
    for (std::uint32_t part = 0; part < parts.size(); ++part) {
      if (parts[part].size() != size) continue;
      nodes.assign(parts[part].begin(), parts[part].end());
      const std::uint32_t other = parts.best_part_for(nodes, limit);
      if (other == NodeParts::kNoPart) continue;
      for (const std::uint32_t node : nodes) parts.move(node, other);
    }
  }
}

/// Moves nodes of `part` to other parts until none can move. Returns whether all have moved.
bool move_all(std::uint32_t part, double limit, NodeParts& parts) {
  std::vector<std::uint32_t> left;
  do {
    left.assign(parts[part].begin(), parts[part].end());
    for (const std::uint32_t node : left) {
      const std::uint32_t other = parts.best_part_for(std::span(&node, 1), limit);
      if (other != NodeParts::kNoPart) parts.move(node, other);
    }
    // A node that has moved may link one that is left with another part.
  } while (!parts[part].empty() && parts[part].size() < left.size());
  return parts[part].empty();
}

}  // namespace

NodeParts connected_parts(const NodeGraph& graph, std::span<const KdPoint> order) {
  NodeParts parts(graph);
  CellSplitter splitter(graph, order);
  for (std::size_t begin = 0; begin < order.size(); begin += kFanOut) splitter.split(begin, parts);
  join_small_parts(parts);
  return parts;
}

void dissolve_small_parts(NodeParts& parts) {
  // Chosen: seven nodes hardly ever all find room, and wider parts would slow down queries.
  constexpr std::size_t kMostNodes = 6;
  constexpr double kStretch = 1.5;  // the largest radius of a part that a node moves to, divided by that of a full one
  const double limit = kStretch * parts.mean_full_radius();
  std::vector<std::uint32_t> nodes;
  for (std::size_t size = 1; size <= kMostNodes; ++size) {
    for (std::uint32_t part = 0; part < parts.size(); ++part) {
      if (parts[part].size() != size) continue;
      nodes.assign(parts[part].begin(), parts[part].end());
      if (move_all(part, limit, parts)) continue;
      for (const std::uint32_t node : nodes) parts.move(node, part);
    }
  }
}

}  // namespace meshhood::inline v0_1
