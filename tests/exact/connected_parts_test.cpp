// SPDX-License-Identifier: MIT
#include "exact/build/connected_parts.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/node_line.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

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

}  // namespace
}  // namespace meshhood::test
