// SPDX-License-Identifier: MIT
#include "exact/build/node_groups.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/node_line.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

TEST(NodeGroups, BecomeTheNodesOfTheLevelAbove) {
  const NodeGraph graph = node_line(9, {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {2, 3}, {6, 7}});
  NodeGroups groups;
  groups.add(std::vector<std::uint32_t>{0, 1, 2});
  groups.add(std::vector<std::uint32_t>{3, 4, 5});
  groups.add(std::vector<std::uint32_t>{6, 7});
  TaskContext task;
  const NodeGraph above = contract(graph, groups, task);
  ASSERT_EQ(above.size(), 3U);
  EXPECT_THAT(above[0], ElementsAre(1));
  EXPECT_THAT(above[1], ElementsAre(0));
  EXPECT_TRUE(above[2].empty());
  EXPECT_EQ(above.balls[1].center.x, 4);
  EXPECT_EQ(above.balls[1].radius, 1.5);
}

}  // namespace
}  // namespace meshhood::test
