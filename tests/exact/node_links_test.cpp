// SPDX-License-Identifier: MIT
// The links between nodes of one level against the edges of the mesh.
#include "exact/build/node_links.h"

#include <cstdio>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "exact/neighbors.h"
#include "exact/node_search.h"
#include "support/families.h"
#include "support/family_name.h"

namespace meshhood::test {
namespace {

using Pairs = std::set<std::pair<NodeId, NodeId>>;

/// The nodes of each level that an edge of the mesh joins.
Pairs pairs_of_edges(const IndexView& index) {
  std::vector<NodeId> leaf_of_vertex(index.vertex_count());
  for (NodeId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    for (std::size_t v = index.leaf_begin[leaf]; v < index.leaf_begin[leaf + 1]; ++v) leaf_of_vertex[v] = leaf;
  }
  Pairs pairs;
  for_each_edge(index, [&](std::size_t from, std::size_t to) {
    NodeId a = leaf_of_vertex[from];
    NodeId b = leaf_of_vertex[to];
    while (a != kNoNode && b != kNoNode && a != b) {
      pairs.emplace(a, b);
      a = index.parents[a / kFanOut];
      b = index.parents[b / kFanOut];
    }
  });
  return pairs;
}

Pairs pairs_of_links(const IndexView& index) {
  Pairs pairs;
  for (std::uint32_t group = 0; group < index.records.size(); ++group) {
    const GroupRecord& record = index.records[group];
    for (unsigned i = 0; i < kFanOut; ++i) {
      for_each_node(record.linked[i], [&](unsigned j) { pairs.emplace(group * kFanOut + i, group * kFanOut + j); });
    }
    NodeId last = 0;
    for (const NodeLink& link : index.node_links_of(record)) {
      EXPECT_GE(link.node(), last) << "not ascending";
      last = link.node() + 1;
      EXPECT_NE(link.node() / kFanOut, group);
      for_each_node(link.mine, [&](unsigned i) { pairs.emplace(group * kFanOut + i, link.node()); });
    }
  }
  return pairs;
}

class NodeLinksOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(NodeLinksOfFamilies, AreThePairsOfNodesThatAnEdgeJoinsOnEveryLevel) {
  std::size_t links = 0;
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const Index built = build(make_mesh(GetParam(), 10, vertices).view());
    const Pairs expected = pairs_of_edges(IndexAccess::view(built));
    ASSERT_EQ(pairs_of_links(IndexAccess::view(built)), expected);
    links += expected.size();
  }
  std::printf("%s: %zu links\n", std::string(GetParam().name).c_str(), links);
}

INSTANTIATE_TEST_SUITE_P(NodeLinks, NodeLinksOfFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
