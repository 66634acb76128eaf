// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/draft.h"
#include "paper/levels.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

std::vector<ClusterId> fused(const DraftLevel& level, double threshold, std::vector<ClusterId> parent) {
  Partition partition{std::move(parent), 0};
  for (const ClusterId p : partition.parent) partition.clusters = std::max<std::size_t>(partition.clusters, p + 1);
  paper::fuse(level, threshold, partition);
  EXPECT_TRUE(is_connected_partition(level, partition));
  return partition.parent;
}

TEST(Fusion, LargeClustersStay) {
  EXPECT_THAT(fused(path_level(6), 3, {0, 0, 0, 1, 1, 1}), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(fused(path_level(6), 0, {0, 0, 1, 1, 2, 2}), ElementsAre(0, 0, 1, 1, 2, 2));
}

TEST(Fusion, TheSmallestClusterIsDissolvedFirst) {
  // Cluster 0 joins cluster 1, which is then large enough.
  EXPECT_THAT(fused(path_level(7), 3, {0, 0, 1, 1, 2, 2, 2}), ElementsAre(0, 0, 0, 0, 1, 1, 1));
}

TEST(Fusion, AClusterWithASingleChildIsDissolvedHoweverLarge) {
  EXPECT_THAT(fused(path_level(3), 0, {0, 0, 1}), ElementsAre(0, 0, 0));
  DraftLevel level = path_level(3);
  level.vertex_count = {1, 1, 1000};
  EXPECT_THAT(fused(level, 2, {0, 0, 1}), ElementsAre(0, 0, 0));
}

TEST(Fusion, TheThresholdCountsVerticesNotChildren) {
  DraftLevel level = path_level(4);
  level.vertex_count = {1, 1, 10, 10};
  EXPECT_THAT(fused(level, 3, {0, 0, 1, 1}), ElementsAre(0, 0, 0, 0));
  level.vertex_count = {2, 2, 10, 10};
  EXPECT_THAT(fused(level, 3, {0, 0, 1, 1}), ElementsAre(0, 0, 1, 1));
}

// Row A13 of docs/reliability.md.
TEST(Fusion, ADonorWithoutSiblingsStays) {
  const DraftLevel pairs = level_on_line({0, 1, 10, 11}, {{0, 1}, {2, 3}});
  EXPECT_THAT(fused(pairs, 1e9, {0, 0, 1, 1}), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(fused(level_on_line({0, 1}, {}), 1e9, {0, 1}), ElementsAre(0, 1));
}

TEST(Fusion, ASmallComponentBecomesOneCluster) {
  EXPECT_THAT(fused(path_level(6), 100, {0, 0, 1, 1, 2, 2}), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST(Fusion, AChildJoinsTheNearestClusterThatItTouches) {
  // The donor {1, 2, 3} is a path. Vertex 1 touches {0, 4}; vertex 3 touches {5, 6}, although it lies near {0, 4}.
  const std::vector<double> xs{0, 1, 2, 0.5, 0.4, 50, 51};
  DraftLevel heavy = level_on_line(xs, {{0, 4}, {0, 1}, {1, 2}, {2, 3}, {3, 5}, {5, 6}});
  for (const std::size_t c : {0U, 4U, 5U, 6U}) {
    heavy.vertex_count[c] = 10;
    heavy.position_sum[c].x *= 10;
  }
  // 2 touches no other cluster at first. It follows 1 into the nearer of the two that it touches then.
  EXPECT_THAT(fused(heavy, 4, {0, 1, 1, 1, 0, 2, 2}), ElementsAre(0, 0, 0, 1, 0, 1, 1));
}

TEST(Fusion, RemainingClustersAreNumberedByTheirFirstChild) {
  EXPECT_THAT(fused(path_level(4), 0, {1, 1, 0, 0}), ElementsAre(0, 0, 1, 1));
}

/// Clusters are large enough after fusion, unless they are whole components.
void expect_large_enough(const TestMesh& mesh, const DraftLevel& level, const Partition& partition, double threshold) {
  for (const auto& children : children_of(partition)) {
    bool touches = false;
    for (const std::uint32_t c : children) {
      for (const ClusterId s : level.siblings[c]) touches |= partition.parent[s] != partition.parent[c];
    }
    if (!touches) continue;
    EXPECT_GE(static_cast<double>(children.size()), threshold) << mesh.name;
    EXPECT_GE(children.size(), 2U) << mesh.name;
  }
}

// Row A14 of docs/reliability.md.
TEST(Fusion, ClustersStayConnected) {
  std::size_t fusions = 0;
  const std::size_t levels = for_each_small_level(scaled(600, 40), [&](const TestMesh& mesh, const DraftLevel& level) {
    for (const double threshold : {0.0, 2.0, 4.0, 16.0, 1e9}) {
      Partition partition = paper::select(level, paper::create(level));
      paper::fuse(level, threshold, partition);
      EXPECT_TRUE(is_connected_partition(level, partition)) << mesh.name << ", threshold " << threshold;
      expect_large_enough(mesh, level, partition, threshold);
      ++fusions;
    }
  });
  std::printf("%zu levels, %zu fusions\n", levels, fusions);
}

}  // namespace
}  // namespace meshhood::test
