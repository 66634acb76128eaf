// SPDX-License-Identifier: MIT
#include "meshhood/index.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "exact/build/leaves.h"
#include "exact/index_access.h"
#include "support/families.h"
#include "support/forged_index.h"
#include "support/index_bytes.h"
#include "support/refusal.h"
#include "support/same_storage.h"

namespace meshhood::test {
namespace {

using testing::IsEmpty;

TEST(IndexBuild, LeavesOfASurfaceAreConnected) {
  const Index built = build(bumpy_grid(200).view());
  const IndexView& index = IndexAccess::view(built);
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    EXPECT_EQ(index.leaves[leaf].connected, index.leaves[leaf].size > 0) << leaf;
  }
}

TEST(IndexBuild, SlotsOfTheLargestNumberOfLeavesHave32Bits) {
  check_leaf_count(kMaxLeaves);
  EXPECT_EQ(std::uint64_t{kMaxLeaves} * kLeafCapacity, std::uint64_t{1} << 32U);
  expect_refused(ErrorCode::TooLarge, "134217729 leaves in the index, but the limit is 134217728",
                 [] { check_leaf_count(kMaxLeaves + 1); });
}

TEST(IndexLevels, DescribeTheLeavesAndTheTreeAboveThem) {
  TestMesh mesh = bumpy_grid(50);
  TestMesh upper = mesh;
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] += 3;
  append(mesh, upper);
  const Index index = build(mesh.view());
  const std::vector<LevelSummary> levels = index.levels();
  const IndexData arrays = arrays_of(index);
  ASSERT_EQ(levels.size(), arrays.levels.size() - 1);
  const auto leaves =
      std::count_if(arrays.leaves.begin(), arrays.leaves.end(), [](const Leaf& l) { return l.size > 0; });
  EXPECT_EQ(levels.front().clusters, static_cast<std::size_t>(leaves));
  EXPECT_EQ(levels.front().mean_siblings,
            static_cast<double>(arrays.links.size() - 1) / static_cast<double>(levels.front().clusters));
  double radius = 0;
  for (const LevelSummary& level : levels) {
    EXPECT_DOUBLE_EQ(level.mean_vertices * static_cast<double>(level.clusters), 5000);
    EXPECT_GT(level.mean_radius, radius);
    EXPECT_LT(level.mean_radius, 50 * std::numbers::sqrt2) << "in the unit of the positions";
    radius = level.mean_radius;
  }
  EXPECT_GT(levels.front().mean_radius, 1);
  EXPECT_THAT(build(TestMesh{}.view()).levels(), IsEmpty());
}

TEST(IndexLevels, CountTheVerticesOfTheirClusters) {
  TestMesh mesh = bumpy_grid(30);
  for (std::size_t i = 0; i < 5000; ++i) mesh.add_vertex(static_cast<double>(i), 100, 0);
  const std::vector<LevelSummary> levels = build(mesh.finish(false).view()).levels();
  ASSERT_GT(levels.size(), 1U);
  for (const LevelSummary& level : levels) {
    // Leaves without a link are in no cluster above.
    EXPECT_DOUBLE_EQ(level.mean_vertices * static_cast<double>(level.clusters), level.level == 0 ? 5900 : 900);
  }
}

TEST(Index, ThatHasBeenMovedFromIsRefusedByEveryCallAndCanBeAssigned) {
  const TestMesh mesh = bumpy_grid(20);
  Index index = build(mesh.view());
  const Index taken = std::move(index);
  const auto refuse = [&](const auto& call) {  // NOLINTBEGIN(bugprone-use-after-move): the subject of this test
    expect_refused(ErrorCode::InvalidOption, "has been moved from", call);
  };
  refuse([&] { return index.vertex_count(); });
  refuse([&] { return index.bytes(); });
  refuse([&] { return index.levels(); });
  refuse([&] { return index.positions(); });
  refuse([&] { return index.permutation(); });
  refuse([&] { return index.leaf_starts(); });
  refuse([&] { return index.faces(); });
  refuse([&] { return index.check(mesh.view()); });
  refuse([&] { index.refit_in_place(mesh.positions_view()); });
  refuse([&] { return refit(index, mesh.positions_view()); });
  refuse([&] { return Searcher(index); });
  refuse([&] { return Searcher(index, Metric::Path); });
  refuse([&] { return nearest(index, {0, 0, 0}); });
  refuse([&] { return counts(index, {.radius = 1.0}); });
  refuse([&] { return quality(index); });
  refuse([&] { return saved(index); });
  index = build(mesh.view());
  // NOLINTEND(bugprone-use-after-move)
  EXPECT_THAT(differences(index, taken), IsEmpty());
}

}  // namespace
}  // namespace meshhood::test
