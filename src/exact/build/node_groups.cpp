// SPDX-License-Identifier: MIT
#include "exact/build/node_groups.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/vector.h"
#include "exact/node_search.h"

namespace meshhood {
namespace {

constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();

/// The sphere around the mean of the centers that holds all spheres.
NodeBall ball_of(const NodeGraph& graph, std::span<const std::uint32_t> a, std::span<const std::uint32_t> b = {}) {
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

/// Cuts each cell of eight nodes into its connected parts, and joins small parts with others.
class Grouping {
 public:
  Grouping(const NodeGraph& graph, std::span<const KdPoint> order)
      : graph_(graph), order_(order), part_of_(graph.size(), kUnset), place_(graph.size(), kUnset) {
    for (std::size_t i = 0; i < order.size(); ++i) place_[order[i].id] = static_cast<std::uint32_t>(i);
  }

  NodeGroups run() {
    for (std::size_t begin = 0; begin < order_.size(); begin += kFanOut) split_cell(begin);
    // The smallest first: a single node has the fewest parts to join.
    const double full = mean_full_radius();
    for (std::size_t size = 1; size <= kFanOut / 2; ++size) {
      const double limit = (size <= 2 ? kSmallStretch : kLargeStretch) * full;
      for (std::uint32_t part = 0; part < parts_.size(); ++part) {
        if (parts_[part].size == size) join(part, limit);  // mutant: small-parts-stay-alone
      }
    }
    NodeGroups groups;
    for (const Part& part : parts_) {
      if (part.size > 0) groups.add(part.members());
    }
    return groups;
  }

 private:
  // The largest radius of a joined part, divided by that of a full one. Chosen: joining a part of one or two nodes
  // gains more.
  static constexpr double kSmallStretch = 2.5;
  static constexpr double kLargeStretch = 1.5;

  struct Part {
    std::array<std::uint32_t, kFanOut> nodes;
    std::size_t size = 0;

    void add(std::uint32_t node) { nodes[size++] = node; }
    [[nodiscard]] std::span<const std::uint32_t> members() const { return std::span(nodes).first(size); }
  };

  void split_cell(std::size_t begin) {
    const auto size = static_cast<unsigned>(std::min<std::size_t>(kFanOut, order_.size() - begin));
    std::array<NodeSet, kFanOut> linked{};
    for (unsigned i = 0; i < size; ++i) {
      for (const std::uint32_t other : graph_[order_[begin + i].id]) {
        // A place before the cell wraps around to a large number.
        const std::size_t place = std::size_t{place_[other]} - begin;
        if (place < size) linked[i] |= static_cast<NodeSet>(1U << place);
      }
    }
    for (unsigned left = first_nodes(size); left != 0;) {
      const NodeSet found = reachable_nodes(linked, static_cast<NodeSet>(left & -left), first_nodes(size));
      left &= ~unsigned{found};
      Part part;
      for (unsigned i = 0; i < size; ++i) {
        if ((found >> i & 1U) == 0) continue;
        part.add(order_[begin + i].id);
        part_of_[order_[begin + i].id] = static_cast<std::uint32_t>(parts_.size());
      }
      parts_.push_back(part);
    }
  }

  /// The mean radius of the parts that fill a cell; infinite if there is none.
  [[nodiscard]] double mean_full_radius() const {
    double sum = 0;
    std::size_t count = 0;
    for (const Part& part : parts_) {
      if (part.size < kFanOut) continue;
      sum += ball_of(graph_, part.members()).radius;
      ++count;
    }
    return count == 0 ? std::numeric_limits<double>::infinity() : sum / static_cast<double>(count);
  }

  /// Joins a part with the linked part that has room where the sphere of both is smallest.
  void join(std::uint32_t part, double limit) {
    std::uint32_t best = kUnset;
    double least = limit;
    for (const std::uint32_t node : parts_[part].members()) {
      for (const std::uint32_t other : graph_[node]) {
        const std::uint32_t next = part_of_[other];
        if (next == part || next == best || parts_[next].size + parts_[part].size > kFanOut) continue;
        const double radius = ball_of(graph_, parts_[part].members(), parts_[next].members()).radius;
        if (radius > least || (radius == least && next > best)) continue;
        least = radius;
        best = next;
      }
    }
    if (best == kUnset) return;
    for (const std::uint32_t node : parts_[part].members()) {
      parts_[best].add(node);
      part_of_[node] = best;
    }
    parts_[part].size = 0;
  }

  const NodeGraph& graph_;
  std::span<const KdPoint> order_;
  std::vector<std::uint32_t> part_of_;  // by node
  std::vector<std::uint32_t> place_;    // by node: its place in `order_`
  std::vector<Part> parts_;
};

}  // namespace

NodeGroups connected_groups(const NodeGraph& graph, std::span<const KdPoint> order) {
  return Grouping(graph, order).run();
}

NodeGraph contract(const NodeGraph& graph, const NodeGroups& groups) {
  std::vector<std::uint32_t> group_of(graph.size(), kUnset);
  for (std::uint32_t group = 0; group < groups.size(); ++group) {
    for (const std::uint32_t node : groups[group]) group_of[node] = group;
  }
  NodeGraph result;
  result.offsets.push_back(0);
  std::vector<std::uint32_t> row;
  for (std::uint32_t group = 0; group < groups.size(); ++group) {
    row.clear();
    for (const std::uint32_t node : groups[group]) {
      for (const std::uint32_t other : graph[node]) {
        if (group_of[other] != group) row.push_back(group_of[other]);
      }
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    result.balls.push_back(ball_of(graph, groups[group]));
    result.neighbors.insert(result.neighbors.end(), row.begin(), row.end());
    result.offsets.push_back(static_cast<std::uint32_t>(result.neighbors.size()));
  }
  return result;
}

}  // namespace meshhood
