// SPDX-License-Identifier: MIT
#include "exact/build/node_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vector.h"

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

}  // namespace meshhood::inline v0_1
