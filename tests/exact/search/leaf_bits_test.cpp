// SPDX-License-Identifier: MIT
// Sets of leaves against the ranges of vertices below nodes.
#include <cstdio>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "exact/search/component.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

/// Whether the leaf is the node or below it, by the vertices that records list.
bool is_below(const IndexView& index, LeafId leaf, NodeId node) {
  for (NodeId above = leaf; above != kNoNode; above = index.parents[above / kFanOut]) {
    if (above == node) return true;
  }
  return false;
}

TEST(LeafBits, HaveTheLeavesBelowTheNodesAddedSinceTheLastClear) {
  const Index built = build(bumpy_grid(110).view());
  const IndexView& index = IndexAccess::view(built);
  ASSERT_GE(index.tree.size(), 3U);
  LeafBits bits(index);
  Random random(4);
  std::size_t in = 0;
  for (int round = 0; round < 200; ++round) {
    bits.clear();
    std::vector<NodeId> added;
    for (std::size_t i = random.below(5); i > 0; --i) {
      const auto group = static_cast<std::uint32_t>(random.below(index.records.size()));
      const auto nodes = static_cast<NodeSet>(random.bits() & first_nodes(index.records[group].nodes));
      bits.add(group, nodes);
      for_each_node(nodes, [&](unsigned place) { added.push_back(group * kFanOut + place); });
    }
    for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
      if (index.leaves[leaf].size == 0) continue;
      const bool expected =
          std::any_of(added.begin(), added.end(), [&](NodeId node) { return is_below(index, leaf, node); });
      ASSERT_EQ(bits.has(leaf) != 0, expected) << "leaf " << leaf;
      in += static_cast<std::size_t>(expected);
    }
    for (const NodeId node : added) {
      if (!index.is_of_leaves(node / kFanOut)) {
        ASSERT_EQ(bits.has_below(node), 1U);
      }
    }
  }
  std::printf("%zu leaves of nodes added\n", in);
  EXPECT_GT(in, 1000U);
}

}  // namespace
}  // namespace meshhood::test
