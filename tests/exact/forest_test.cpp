// SPDX-License-Identifier: MIT
// The groups of all levels: nodes that are not linked are never grouped together.
#include "exact/build/forest.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/reference.h"

#include "exact/build/node_parts.h"
#include "exact/index_access.h"
#include "exact/node_search.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

class ForestOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(ForestOfFamilies, EveryNodeAboveTheLeavesIsConnectedByLinksBetweenItsChildren) {
  std::size_t nodes = 0;
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const Index built = build(make_mesh(GetParam(), 7, vertices).view());
    const IndexView& index = IndexAccess::view(built);
    for (std::size_t group = 0; group < index.records.size(); ++group) {
      if (index.parents[group] == kNoNode) continue;
      const GroupRecord& record = index.records[group];
      ASSERT_EQ(reachable_nodes(record.linked, 1, first_nodes(record.nodes)), first_nodes(record.nodes)) << group;
      ++nodes;
    }
  }
  std::printf("%s: %zu nodes above the leaves\n", std::string(GetParam().name).c_str(), nodes);
}

TEST_P(ForestOfFamilies, ANodeOfMoreThanOneLeafHoldsVerticesOfOneComponentOfTheMesh) {
  const TestMesh mesh = make_mesh(GetParam(), 8, 2000);
  if (mesh.size() == 0) return;
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  ReferenceSearcher everything(mesh.view());
  std::vector<VertexId> component;
  for (std::size_t group = 0; group < index.records.size(); ++group) {
    if (index.parents[group] == kNoNode) continue;
    const GroupRecord& record = index.records[group];
    everything.neighborhood(index.id(record.begin.front()), std::numeric_limits<double>::infinity(), component);
    const std::set<VertexId> own(component.begin(), component.end());
    for (std::size_t v = record.begin.front(); v < record.begin.back(); ++v) ASSERT_TRUE(own.contains(index.id(v)));
  }
}

TEST_P(ForestOfFamilies, EachGroupIsCoveredByOneNodeOfTheLevelAboveOrByNone) {
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const Index built = build(make_mesh(GetParam(), 9, vertices).view());
    const IndexView& index = IndexAccess::view(built);
    std::vector<NodeId> expected(index.records.size(), kNoNode);
    for (std::size_t level = 1; level < index.tree.size(); ++level) {
      for (std::size_t group = index.levels[level]; group < index.levels[level + 1]; ++group) {
        const GroupRecord& record = index.records[group];
        for (std::size_t i = 0; i < record.nodes; ++i) {
          ASSERT_GE(record.first_child + i, index.levels[level - 1]);
          ASSERT_LT(record.first_child + i, index.levels[level]);
          expected[record.first_child + i] = static_cast<NodeId>(group * kFanOut + i);
        }
      }
    }
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), index.parents.begin(), index.parents.end()));
  }
}

INSTANTIATE_TEST_SUITE_P(Forest, ForestOfFamilies, testing::ValuesIn(families()), family_name);

Forest forest_of(const NodeGraph& graph) {
  TaskContext task;
  return make_forest(graph, task);
}

/// Leaves in a row, each linked with the next within runs of `run`.
NodeGraph rows_of(std::size_t leaves, std::size_t run) {
  NodeGraph graph;
  graph.neighbors.offsets.push_back(0);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    graph.balls.push_back({{static_cast<double>(leaf), 0, 0}, 0.5});
    if (leaf % run != 0) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf - 1));
    if (leaf % run + 1 != run) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf + 1));
    graph.neighbors.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.values.size()));
  }
  return graph;
}

TEST(Forest, OfLeavesWithoutLinksHasRootGroupsOfEight) {
  const Forest forest = forest_of(rows_of(20, 1));
  EXPECT_EQ(forest.levels, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(forest.records[0].nodes + forest.records[1].nodes + forest.records[2].nodes, 20U);
  EXPECT_EQ(forest.parents, std::vector<NodeId>(3, kNoNode));
}

TEST(Forest, OfOneRowEndsInOneNodeWithoutLinks) {
  const Forest forest = forest_of(rows_of(64, 64));
  ASSERT_EQ(forest.levels.size(), 4U);
  EXPECT_EQ(forest.records.back().nodes, 1U);
  EXPECT_EQ(forest.leaves.size() % kFanOut, 0U);
}

TEST(Forest, AroundAHubStopsWhereGroupingNoLongerHelps) {
  NodeGraph star;
  star.neighbors.offsets = {0, 999};
  star.balls.assign(1000, {{0, 0, 0}, 1});
  for (std::uint32_t leaf = 1; leaf < 1000; ++leaf) star.neighbors.values.push_back(leaf);
  for (std::uint32_t leaf = 1; leaf < 1000; ++leaf) {
    star.neighbors.values.push_back(0);
    star.neighbors.offsets.push_back(static_cast<std::uint32_t>(star.neighbors.values.size()));
  }
  const Forest forest = forest_of(star);
  EXPECT_EQ(forest.levels.size(), 2U);
  EXPECT_EQ(forest.parents, std::vector<NodeId>(125, kNoNode));
}

/// Parallel sheets of `side` by `side` leaves, linked with their neighbors in the same sheet. The leaves are moved at
/// random, across the sheets as far as these are apart.
NodeGraph sheets_of(std::size_t sheets, std::size_t side) {
  NodeGraph graph;
  Random random(sheets);
  graph.neighbors.offsets.push_back(0);
  for (std::size_t leaf = 0; leaf < sheets * side * side; ++leaf) {
    const std::size_t x = leaf % side;
    const std::size_t y = leaf / side % side;
    const double z = static_cast<double>(sheets - 1) * random.uniform();
    graph.balls.push_back(
        {{static_cast<double>(x) + random.uniform(), static_cast<double>(y) + random.uniform(), z}, 1});
    if (y > 0) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf - side));
    if (x > 0) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf - 1));
    if (x + 1 < side) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf + 1));
    if (y + 1 < side) graph.neighbors.values.push_back(static_cast<std::uint32_t>(leaf + side));
    graph.neighbors.offsets.push_back(static_cast<std::uint32_t>(graph.neighbors.values.size()));
  }
  return graph;
}

/// The connected parts from which `make_forest` makes the groups of the leaves, which are all linked.
NodeParts undissolved_parts_of(const NodeGraph& graph) {
  std::vector<KdPoint> order;
  for (std::uint32_t leaf = 0; leaf < graph.size(); ++leaf) {
    const Point& p = graph.balls[leaf].center;
    order.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}, leaf});
  }
  kd_order(order, kFanOut);
  return connected_parts(graph, order);
}

TEST(Forest, DissolvesSmallGroupsWhereManyPlacesWouldStayEmpty) {
  const NodeGraph graph = sheets_of(2, 40);
  NodeParts parts = undissolved_parts_of(graph);
  const std::size_t before = parts.groups().size();
  EXPECT_LT(parts.fill(), 0.85);
  dissolve_small_parts(parts);
  EXPECT_GT(parts.fill(), 0.85);
  EXPECT_LT(parts.groups().size(), before);
  EXPECT_EQ(forest_of(graph).levels[1], parts.groups().size());
}

TEST(Forest, KeepsSmallGroupsWhereFewPlacesStayEmpty) {
  const NodeGraph graph = sheets_of(1, 40);
  NodeParts parts = undissolved_parts_of(graph);
  const std::size_t kept = parts.groups().size();
  EXPECT_GE(parts.fill(), 0.85);
  EXPECT_EQ(forest_of(graph).levels[1], kept);
  dissolve_small_parts(parts);
  EXPECT_LT(parts.groups().size(), kept);
}

TEST(Forest, OfNoLeafHasNoLevel) {
  const Forest forest = forest_of(NodeGraph{});
  EXPECT_EQ(forest.levels, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(forest.records.empty());
}

}  // namespace
}  // namespace meshhood::test
