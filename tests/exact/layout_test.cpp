// SPDX-License-Identifier: MIT
// What an index derives from its arrays.
#include "exact/layout.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

class LeafGroupsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(LeafGroupsOnFamilies, AreThoseOfTheLeavesBelowEachNode) {
  std::size_t nodes = 0;
  for (const std::size_t vertices : {60U, 700U, 6000U}) {
    const Index built = build(make_mesh(GetParam(), 1, vertices).view());
    const IndexView& index = IndexAccess::view(built);
    std::vector<LeafGroupRange> expected(index.records.size() * kFanOut, {0xFFFFFFFF, 0});
    for (std::uint32_t group = 0; group < index.leaf_count() / kFanOut; ++group) {
      for (NodeId node = index.parents[group]; node != kNoNode; node = index.parents[node / kFanOut]) {
        expected[node].begin = std::min(expected[node].begin, group);
        expected[node].end = std::max(expected[node].end, group + 1);
      }
    }
    for (std::size_t group = index.leaf_count() / kFanOut; group < index.records.size(); ++group) {
      ASSERT_FALSE(index.is_of_leaves(group));
      for (std::size_t i = 0; i < index.records[group].nodes; ++i, ++nodes) {
        const auto node = static_cast<NodeId>(group * kFanOut + i);
        const LeafGroupRange& range = index.leaf_groups_of(node);
        ASSERT_EQ(range.begin, expected[node].begin) << "node " << node;
        ASSERT_EQ(range.end, expected[node].end) << "node " << node;
        // The vertices of the groups are those of the node, so that no other node is below them.
        ASSERT_EQ(index.records[range.begin].begin.front(), index.records[group].begin[i]);
        ASSERT_EQ(index.records[range.end - 1].begin.back(), index.records[group].begin[i + 1]);
      }
    }
  }
  std::printf("%zu nodes\n", nodes);
}

INSTANTIATE_TEST_SUITE_P(Families, LeafGroupsOnFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
