// SPDX-License-Identifier: MIT
#include "exact/build/node_parts.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/node_line.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

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

}  // namespace
}  // namespace meshhood::test
