// SPDX-License-Identifier: MIT
#include "exact/build/node_groups.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/layout.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// Nodes on a line, and links between some of them.
NodeGraph line(std::size_t nodes, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links) {
  NodeGraph graph;
  graph.offsets.push_back(0);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    graph.balls.push_back({{static_cast<double>(node), 0, 0}, 0.5});
    for (const auto& [a, b] : links) {
      if (a == node) graph.neighbors.push_back(b);
      if (b == node) graph.neighbors.push_back(a);
    }
    graph.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.size()));
  }
  return graph;
}

std::vector<KdPoint> in_order(std::size_t nodes) {
  std::vector<KdPoint> order;
  for (std::uint32_t node = 0; node < nodes; ++node) order.push_back({{static_cast<float>(node), 0, 0}, node});
  return order;
}

std::vector<std::uint32_t> sorted_group(const NodeGroups& groups, std::size_t group) {
  std::vector<std::uint32_t> nodes(groups[group].begin(), groups[group].end());
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

TEST(NodeGroups, AreTheConnectedPartsOfEachEight) {
  const NodeGraph graph = line(8, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {5, 6}, {6, 7}});
  const NodeGroups groups = connected_groups(graph, in_order(8));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_THAT(sorted_group(groups, 0), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(sorted_group(groups, 1), ElementsAre(5, 6, 7));
}

TEST(NodeGroups, JoinASmallPartWithALinkedPartThatHasRoom) {
  // Node 8 is alone in its cell, and linked with the part of 6 and 7.
  const NodeGraph graph = line(9, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {6, 7}, {7, 8}});
  const NodeGroups groups = connected_groups(graph, in_order(9));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_THAT(sorted_group(groups, 0), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(sorted_group(groups, 1), ElementsAre(6, 7, 8));
}

TEST(NodeGroups, HoldEightNodesAtMost) {
  const NodeGraph graph = line(9, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 8}});
  const NodeGroups groups = connected_groups(graph, in_order(9));
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].size(), kFanOut);
}

TEST(NodeGroups, BecomeTheNodesOfTheLevelAbove) {
  const NodeGraph graph = line(9, {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {2, 3}, {6, 7}});
  NodeGroups groups;
  groups.add(std::vector<std::uint32_t>{0, 1, 2});
  groups.add(std::vector<std::uint32_t>{3, 4, 5});
  groups.add(std::vector<std::uint32_t>{6, 7});
  const NodeGraph above = contract(graph, groups);
  ASSERT_EQ(above.size(), 3U);
  EXPECT_THAT(above[0], ElementsAre(1));
  EXPECT_THAT(above[1], ElementsAre(0));
  EXPECT_TRUE(above[2].empty());
  EXPECT_EQ(above.balls[1].center.x, 4);
  EXPECT_EQ(above.balls[1].radius, 1.5);
}

}  // namespace
}  // namespace meshhood::test
