// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "exact/search/reach.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

TEST(GroupStates, OfAnEarlierQueryAreNotKnown) {
  const Index built = build(make_grid(40, 40, false).view());
  const IndexView& index = IndexAccess::view(built);
  GroupStates states(index);
  states.start(index.records.size());
  states.set(3, {.whole = 5});
  EXPECT_TRUE(states.is_known(3));
  EXPECT_FALSE(states.is_known(4));
  states.start(index.records.size());
  EXPECT_FALSE(states.is_known(3));
}

TEST(GroupStates, FindTheWholeNodeThatCoversANode) {
  const Index built = build(make_grid(80, 80, false).view());
  const IndexView& index = IndexAccess::view(built);
  ASSERT_GE(index.tree.size(), 3U);
  const NodeId leaf = 9;
  const NodeId parent = index.parents[leaf / kFanOut];
  const NodeId top = index.parents[parent / kFanOut];
  GroupStates states(index);
  states.start(index.tree[2].first_group + index.tree[2].groups);
  EXPECT_EQ(states.whole_node(leaf), kNoNode);
  states.set(top / kFanOut, {.whole = static_cast<NodeSet>(1U << top % kFanOut)});
  EXPECT_EQ(states.whole_node(leaf), top);
  // A known group below says that the node above was refined.
  states.set(leaf / kFanOut, {.intersecting = 0xFF});
  EXPECT_EQ(states.whole_node(leaf), kNoNode);
  // Levels above the outward search do not count.
  states.start(index.tree[1].first_group + index.tree[1].groups);
  states.set(top / kFanOut, {.whole = 0xFF});
  EXPECT_EQ(states.whole_node(leaf), kNoNode);
}

}  // namespace
}  // namespace meshhood::test
