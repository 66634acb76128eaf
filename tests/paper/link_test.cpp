// SPDX-License-Identifier: MIT
#include <cstdio>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/draft.h"
#include "paper/levels.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// The pairs of clusters that an edge joins, computed directly.
std::vector<std::set<std::uint32_t>> joined(const DraftLevel& below, const Partition& partition) {
  std::vector<std::set<std::uint32_t>> sets(partition.clusters);
  for (std::size_t c = 0; c < below.size(); ++c) {
    for (const ClusterId s : below.siblings[c]) {
      if (partition.parent[s] != partition.parent[c]) sets[partition.parent[c]].insert(partition.parent[s]);
    }
  }
  return sets;
}

TEST(Link, ParentsOfSiblingsAreSiblings) {
  const DraftLevel level = paper::link(path_level(6), {{0, 0, 1, 1, 2, 2}, 3});
  EXPECT_THAT(level.siblings[0], ElementsAre(1));
  EXPECT_THAT(level.siblings[1], ElementsAre(0, 2));
  EXPECT_THAT(level.siblings[2], ElementsAre(1));
}

TEST(Link, AWholeComponentHasNoSiblings) {
  const DraftLevel level = paper::link(level_on_line({0, 1, 2}, {{0, 1}}), {{0, 0, 1}, 2});
  EXPECT_THAT(level.siblings[0], ElementsAre());
  EXPECT_THAT(level.siblings[1], ElementsAre());
}

TEST(Link, VertexCountsAndPositionsAreSummed) {
  DraftLevel below = path_level(3);
  below.vertex_count = {1, 5, 7};
  const DraftLevel level = paper::link(below, {{0, 1, 1}, 2});
  EXPECT_THAT(level.vertex_count, ElementsAre(1, 12));
  EXPECT_EQ(level.position_sum[0].x, 0.0);
  EXPECT_EQ(level.position_sum[1].x, 3.0);
}

TEST(Link, SiblingsAreExactlyThePairsThatAnEdgeJoinsOnEachLevel) {
  std::size_t links = 0;
  for_each_small_level(scaled(600, 40), [&](const TestMesh& mesh, DraftLevel below) {
    for (int l = 0; l < 3; ++l, ++links) {
      const Partition partition = paper::select(below, paper::create(below));
      DraftLevel level = paper::link(below, partition);
      ASSERT_EQ(sibling_sets(level), joined(below, partition)) << mesh.name;
      below = std::move(level);
    }
  });
  std::printf("%zu links\n", links);
}

TEST(Enclose, SpheresAndTheirMeanRadius) {
  paper::Level<float> level;
  level.first_vertex = {0, 2, 3};
  const std::vector<float> positions{0, 0, 0, 2, 0, 0, 9, 9, 9};
  paper::enclose<float>(positions, level);
  ASSERT_EQ(level.spheres.size(), 2U);
  EXPECT_FLOAT_EQ(level.spheres[0].radius, 1);
  EXPECT_FLOAT_EQ(level.spheres[0].x, 1);
  EXPECT_EQ(level.spheres[1].radius, 0);
  EXPECT_EQ(level.mean_radius, static_cast<double>(level.spheres[0].radius) / 2);
}

}  // namespace
}  // namespace meshhood::test
