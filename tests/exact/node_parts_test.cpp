// SPDX-License-Identifier: MIT
#include "exact/build/node_parts.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/divided_nodes.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Nodes on a line, at their numbers, and links between some of them.
NodeGraph node_line(std::size_t nodes, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& links) {
  NodeGraph graph;
  for (std::uint32_t node = 0; node < nodes; ++node) {
    graph.balls.push_back({{static_cast<double>(node), 0, 0}, 0.5});
    std::vector<std::uint32_t> neighbors;
    for (const auto& [a, b] : links) {
      if (a == node) neighbors.push_back(b);
      if (b == node) neighbors.push_back(a);
    }
    graph.neighbors.add(neighbors);
  }
  return graph;
}

/// Links between each two successive nodes from `first` to `last`.
std::vector<std::pair<std::uint32_t, std::uint32_t>> chain(std::uint32_t first, std::uint32_t last) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  for (std::uint32_t node = first; node < last; ++node) links.emplace_back(node, node + 1);
  return links;
}

/// The nodes from `first` to `last`.
std::vector<std::uint32_t> nodes_from(std::uint32_t first, std::uint32_t last) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t node = first; node <= last; ++node) nodes.push_back(node);
  return nodes;
}

TEST(NodeParts, BecomeGroupsWithoutThoseThatHaveLostAllNodes) {
  const NodeGraph graph = node_line(12, chain(0, 11));
  NodeParts parts(graph);
  parts.add(nodes_from(0, 6));
  parts.add(nodes_from(7, 7));
  parts.add(nodes_from(8, 11));
  EXPECT_EQ(parts.fill(), 0.5);
  parts.move(7, 0);
  EXPECT_EQ(parts.part_of(7), 0U);
  EXPECT_EQ(parts.fill(), 0.75);
  const NodeGroups groups = parts.groups();
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_THAT(groups[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(groups[1], ElementsAre(8, 9, 10, 11));
}

TEST(NodeParts, KnowTheMeanRadiusOfTheFullOnes) {
  const NodeGraph graph = node_line(12, chain(0, 11));
  NodeParts parts(graph);
  parts.add(nodes_from(8, 11));
  EXPECT_EQ(parts.mean_full_radius(), std::numeric_limits<double>::infinity());
  parts.add(nodes_from(0, 7));
  EXPECT_EQ(parts.mean_full_radius(), 4);
}

TEST(NodeParts, FindTheLinkedPartWithRoomThatStaysSmallest) {
  // Node 8 is linked with a full part, a near one and a far one.
  auto links = chain(0, 8);
  links.emplace_back(8, 10);
  links.emplace_back(8, 20);
  const NodeGraph graph = node_line(21, links);
  NodeParts parts(graph);
  parts.add(nodes_from(0, 7));
  parts.add(nodes_from(8, 8));
  parts.add(nodes_from(20, 20));
  parts.add(nodes_from(9, 10));
  const std::vector<std::uint32_t> node{8};
  EXPECT_EQ(parts.best_part_for(node, 100), 3U);
  EXPECT_EQ(parts.best_part_for(node, 1.4), NodeParts::kNoPart);
}

/// The parts of nodes on a line, which is their kd order.
NodeGroups parts_of(const NodeGraph& graph) {
  std::vector<KdPoint> order;
  for (std::uint32_t node = 0; node < graph.size(); ++node) order.push_back({{static_cast<float>(node), 0, 0}, node});
  return connected_parts(graph, order).groups();
}

TEST(ConnectedParts, AreTheConnectedPartsOfEachEight) {
  const NodeGroups parts = parts_of(node_line(8, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {5, 6}, {6, 7}}));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(parts[1], ElementsAre(5, 6, 7));
}

TEST(ConnectedParts, JoinASmallPartWithALinkedPartThatHasRoom) {
  // Node 8 is alone in its cell, and linked with the part of 6 and 7.
  const NodeGroups parts = parts_of(node_line(9, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {6, 7}, {7, 8}}));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(parts[1], UnorderedElementsAre(6, 7, 8));
}

TEST(ConnectedParts, HoldEightNodesAtMost) {
  const NodeGroups parts = parts_of(node_line(9, chain(0, 8)));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].size(), 8U);
}

/// The parts, after small ones were dissolved.
NodeParts dissolved(const NodeGraph& graph, const std::vector<std::vector<std::uint32_t>>& nodes) {
  NodeParts parts(graph);
  for (const auto& part : nodes) parts.add(part);
  dissolve_small_parts(parts);
  return parts;
}

TEST(DissolveParts, MovesTheNodesOfASmallPartToLinkedPartsWithRoom) {
  const NodeGraph graph = node_line(16, chain(0, 15));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 6), {7, 8}, nodes_from(9, 15)});
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(parts[1], IsEmpty());
  EXPECT_THAT(parts[2], ElementsAre(9, 10, 11, 12, 13, 14, 15, 8));
}

TEST(DissolveParts, LeavesAPartAsItWasIfOneOfItsNodesFindsNoRoom) {
  // Node 9 finds room, and node 8 does not.
  const NodeGraph graph = node_line(17, chain(0, 16));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 7), {8, 9}, nodes_from(10, 16)});
  EXPECT_THAT(parts[1], ElementsAre(8, 9));
  EXPECT_THAT(parts[2], ElementsAre(10, 11, 12, 13, 14, 15, 16));
}

TEST(DissolveParts, MovesANodeThatIsLinkedOnlyWithOneThatHasMoved) {
  const NodeGraph graph = node_line(8, chain(0, 7));
  const NodeParts parts = dissolved(graph, {nodes_from(0, 5), {7, 6}});
  EXPECT_THAT(parts[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(DissolveParts, MakesNoPartMuchWider) {
  auto links = chain(0, 7);
  links.emplace_back(8, 14);
  for (const auto& link : chain(14, 20)) links.push_back(link);
  const NodeGraph graph = node_line(21, links);
  const NodeParts parts = dissolved(graph, {nodes_from(0, 7), {8}, nodes_from(14, 20)});
  EXPECT_THAT(parts[1], ElementsAre(8));
}

TEST(DissolveParts, KeepsPartsConnectedAndNarrowWhateverTheNodes) {
  Random random(17);
  std::size_t dissolved = 0;
  const std::size_t cases = scaled(20'000, 500);
  for (std::size_t i = 0; i < cases; ++i) {
    const DividedNodes before = draw_divided_nodes(random);
    NodeParts after = before.node_parts();
    dissolve_small_parts(after);
    ASSERT_EQ(fault_of(before, after), "") << "case " << i;
    NodeParts again = before.node_parts();
    dissolve_small_parts(again);
    for (std::uint32_t part = 0; part < after.size(); ++part) {
      ASSERT_TRUE(std::ranges::equal(after[part], again[part])) << "case " << i;
      dissolved += static_cast<std::size_t>(after[part].empty());
    }
  }
  std::printf("%zu parts dissolved in %zu cases\n", dissolved, cases);
  EXPECT_GT(dissolved, cases / 4);
}

}  // namespace
}  // namespace meshhood::test
