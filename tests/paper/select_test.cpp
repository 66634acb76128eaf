// SPDX-License-Identifier: MIT
#include "paper/select.h"

#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/levels.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::Each;
using testing::ElementsAre;

Partition select(const DraftLevel& level) { return paper::select(level, paper::create(level)); }

/// Whether each cluster is one of its children with siblings of that child.
bool made_around_a_centre(const DraftLevel& level, const Partition& partition) {
  const auto siblings = sibling_sets(level);
  return std::ranges::all_of(children_of(partition), [&](const auto& children) {
    return std::ranges::any_of(children, [&](std::uint32_t centre) {
      return std::ranges::all_of(children,
                                 [&](std::uint32_t c) { return c == centre || siblings[centre].contains(c); });
    });
  });
}

TEST(Select, TakesTheCandidateNearestToTheAverageFirst) {
  // Counts 2, 3, 2 with average 7/3: the end of the path comes first, and leaves the other end alone.
  EXPECT_THAT(select(path_level(3)).parent, ElementsAre(0, 0, 1));
}

TEST(Select, DropsACandidateWhoseClusterIsTaken) {
  // The average of the star is below 3, so a leaf is first; what is left of the hub's candidate has no hub.
  const Partition partition = select(star_level(5));
  EXPECT_THAT(partition.parent, ElementsAre(0, 0, 1, 2, 3, 4));
}

TEST(Select, TakesACliqueWhole) {
  const TestMesh mesh = make_mesh(*std::ranges::find(trap_families(), "clique", &Family::name), 3, 30);
  const Partition partition = select(base_level(mesh));
  EXPECT_EQ(partition.clusters, 1U);
  EXPECT_THAT(partition.parent, Each(0U));
}

TEST(Select, LeavesEveryIsolatedClusterAlone) {
  EXPECT_THAT(select(level_on_line({0, 1, 2}, {})).parent, ElementsAre(0, 1, 2));
}

TEST(Select, CoversAGridInFewClusters) {
  const DraftLevel level = base_level(make_grid(30, 30, false));
  const Partition partition = select(level);
  EXPECT_TRUE(is_connected_partition(level, partition));
  EXPECT_LE(partition.clusters, level.size() / 3);
}

TEST(Select, CoversEachOnceWithConnectedClusters) {
  const std::size_t levels = for_each_small_level(scaled(1000, 40), [](const TestMesh& mesh, const DraftLevel& level) {
    const Partition partition = select(level);
    EXPECT_TRUE(is_connected_partition(level, partition)) << mesh.name;
    EXPECT_TRUE(made_around_a_centre(level, partition)) << mesh.name;
  });
  std::printf("%zu levels\n", levels);
}

}  // namespace
}  // namespace meshhood::test
