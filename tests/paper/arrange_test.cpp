// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/hierarchy.h"
#include "paper/levels.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using paper::Hierarchy;
using paper::Level;
using testing::ElementsAre;
using testing::IsEmpty;

/// Vertices 0 to 5 on a path; clusters {0, 3}, {1, 4}, {2, 5} below {clusters 0 and 2}, {cluster 1}.
struct Example {
  std::vector<double> xyz = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0};
  DraftLevel base = path_level(6);
  Adjacency middle{{0, 1, 3, 4}, {1, 0, 2, 1}};
  Adjacency top{{0, 1, 2}, {1, 0}};
  std::vector<std::vector<ClusterId>> parents{{0, 1, 2, 0, 1, 2}, {0, 1, 0}};

  [[nodiscard]] Hierarchy<double> arranged(std::size_t lowest) const {
    return paper::arrange<double>(xyz, parents, {base.siblings, middle.view(), top.view()}, lowest);
  }
};

TEST(Arrange, VerticesOfEachClusterAreContiguous) {
  const Hierarchy<double> hierarchy = Example().arranged(0);
  EXPECT_THAT(hierarchy.vertices, ElementsAre(0, 3, 2, 5, 1, 4));
  ASSERT_EQ(hierarchy.levels.size(), 3U);
  EXPECT_THAT(hierarchy.levels[1].first_vertex, ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(hierarchy.levels[2].first_vertex, ElementsAre(0, 4, 6));
  EXPECT_THAT(hierarchy.levels[1].first_child, ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(hierarchy.levels[2].first_child, ElementsAre(0, 2, 3));
  EXPECT_THAT(hierarchy.levels[0].parent, ElementsAre(0, 0, 1, 1, 2, 2));
  EXPECT_THAT(hierarchy.levels[1].parent, ElementsAre(0, 0, 1));
  EXPECT_THAT(hierarchy.levels[2].parent, IsEmpty());
}

TEST(Arrange, PositionsAndSiblingsFollowTheNewOrder) {
  const Hierarchy<double> hierarchy = Example().arranged(1);
  EXPECT_THAT(hierarchy.positions, ElementsAre(0, 0, 0, 3, 0, 0, 2, 0, 0, 5, 0, 0, 1, 0, 0, 4, 0, 0));
  // The old middle cluster 1 is the new 2. It has both others as siblings.
  EXPECT_THAT(hierarchy.levels[0].siblings.view()[0], ElementsAre(2));
  EXPECT_THAT(hierarchy.levels[0].siblings.view()[1], ElementsAre(2));
  EXPECT_THAT(hierarchy.levels[0].siblings.view()[2], ElementsAre(0, 1));
}

TEST(Arrange, LevelsBelowTheLowestAreDropped) {
  for (std::size_t lowest = 0; lowest < 3; ++lowest) {
    const Hierarchy<double> hierarchy = Example().arranged(lowest);
    ASSERT_EQ(hierarchy.levels.size(), 3 - lowest);
    EXPECT_EQ(hierarchy.levels.front().number, static_cast<int>(lowest));
    EXPECT_THAT(hierarchy.levels.front().first_child, IsEmpty());
    EXPECT_THAT(hierarchy.levels.back().parent, IsEmpty());
    EXPECT_THAT(hierarchy.vertices, ElementsAre(0, 3, 2, 5, 1, 4));
  }
}

TEST(Arrange, EachVertexRefersToItsLowestCluster) {
  const Hierarchy<double> hierarchy = Example().arranged(1);
  const std::vector<std::uint64_t> expected{0, 2, 1, 0, 2, 1};
  for (std::size_t v = 0; v < expected.size(); ++v) EXPECT_EQ(hierarchy.lowest_cluster[v], expected[v]) << v;
}

TEST(Arrange, AMeshWithoutVerticesGivesOneEmptyLevel) {
  const Adjacency none{{0}, {}};
  const Hierarchy<double> hierarchy = paper::arrange<double>({}, {}, {none.view()}, 0);
  EXPECT_THAT(hierarchy.vertices, IsEmpty());
  ASSERT_EQ(hierarchy.levels.size(), 1U);
  EXPECT_EQ(hierarchy.levels[0].size(), 0U);
}

TEST(Arrange, ChildrenOfRandomParentsAreContiguous) {
  std::size_t cases = 0;
  for (std::uint64_t seed = 0; seed < scaled(300, 20); ++seed, ++cases) {
    Random random(seed);
    const std::size_t vertices = 1 + random.below(200);
    const std::size_t clusters = 1 + random.below(vertices);
    std::vector<ClusterId> parent(vertices);
    std::iota(parent.begin(), parent.begin() + static_cast<std::ptrdiff_t>(clusters), ClusterId{0});
    for (std::size_t v = clusters; v < vertices; ++v) parent[v] = static_cast<ClusterId>(random.below(clusters));
    const Adjacency apart{std::vector<EdgeOffset>(clusters + 1, 0), {}};
    const Adjacency base{std::vector<EdgeOffset>(vertices + 1, 0), {}};
    const std::vector<double> xyz(3 * vertices, 0.0);
    const auto hierarchy = paper::arrange<double>(xyz, {parent}, {base.view(), apart.view()}, 1);
    const Level<double>& level = hierarchy.levels.front();
    ASSERT_EQ(level.size(), clusters);
    for (std::size_t c = 0; c < clusters; ++c) {
      for (std::size_t i = level.first_vertex[c]; i < level.first_vertex[c + 1]; ++i) {
        ASSERT_EQ(parent[hierarchy.vertices[i]], c) << "seed " << seed;
        ASSERT_EQ(hierarchy.lowest_cluster[hierarchy.vertices[i]], c) << "seed " << seed;
      }
    }
  }
  std::printf("%zu arrangements\n", cases);
}

TEST(PackedIds, NumbersAreReadAsTheyWereSet) {
  std::size_t numbers = 0;
  for (unsigned width = 0; width <= 32; ++width) {
    const std::uint64_t bound = std::uint64_t{1} << width;
    Random random(width);
    std::vector<std::uint64_t> expected(200);
    paper::PackedIds ids(expected.size(), bound);
    for (std::size_t i = 0; i < expected.size(); ++i, ++numbers) {
      expected[i] = i % 7 == 0 ? bound - 1 : random.bits() % bound;
      ids.set(i, expected[i]);
    }
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(ids[i], expected[i]) << "width " << width;
  }
  std::printf("%zu numbers\n", numbers);
}

}  // namespace
}  // namespace meshhood::test
