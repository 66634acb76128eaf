// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/draft.h"
#include "paper/levels.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::Each;
using testing::ElementsAre;

Partition select(const DraftLevel& level) { return paper::select(level, paper::create(level)); }

/// Whether each cluster consists of one of its children and siblings of that child.
bool is_made_around_a_center(const DraftLevel& level, const Partition& partition) {
  const auto siblings = sibling_sets(level);
  return std::ranges::all_of(children_of(partition), [&](const auto& children) {
    return std::ranges::any_of(children, [&](std::uint32_t center) {
      return std::ranges::all_of(children,
                                 [&](std::uint32_t c) { return c == center || siblings[center].contains(c); });
    });
  });
}

TEST(Select, TheCandidateNearestToTheAverageIsFirst) {
  // Counts 2, 3, 2 with average 7/3: one end of the path comes first, and the other end remains alone.
  EXPECT_THAT(select(path_level(3)).parent, ElementsAre(0, 0, 1));
}

TEST(Select, ACandidateWhoseClusterHasAParentIsDropped) {
  // The average of the star is below 3, so a vertex of degree 1 comes first and takes the hub.
  const Partition partition = select(star_level(5));
  EXPECT_THAT(partition.parent, ElementsAre(0, 0, 1, 2, 3, 4));
}

TEST(Select, ACliqueBecomesOneCluster) {
  const TestMesh mesh = make_mesh(*std::ranges::find(trap_families(), "clique", &Family::name), 3, 30);
  const Partition partition = select(base_level(mesh));
  EXPECT_EQ(partition.clusters, 1U);
  EXPECT_THAT(partition.parent, Each(0U));
}

TEST(Select, IsolatedClustersStayAlone) {
  EXPECT_THAT(select(level_on_line({0, 1, 2}, {})).parent, ElementsAre(0, 1, 2));
}

TEST(Select, AGridShrinksToAThirdAtMost) {
  const DraftLevel level = base_level(make_grid(30, 30, false));
  const Partition partition = select(level);
  EXPECT_TRUE(is_connected_partition(level, partition));
  EXPECT_LE(partition.clusters, level.size() / 3);
}

TEST(Select, EachClusterHasOneParentAndParentsAreConnected) {
  const std::size_t levels = for_each_small_level(scaled(1000, 40), [](const TestMesh& mesh, const DraftLevel& level) {
    const Partition partition = select(level);
    EXPECT_TRUE(is_connected_partition(level, partition)) << mesh.name;
    EXPECT_TRUE(is_made_around_a_center(level, partition)) << mesh.name;
  });
  std::printf("%zu levels\n", levels);
}

}  // namespace
}  // namespace meshhood::test
