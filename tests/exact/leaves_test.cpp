// SPDX-License-Identifier: MIT
#include "exact/build/leaves.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/sphere.h"
#include "exact/layout.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

LeafPartition leaves_of(const TestMesh& mesh, unsigned threads = 1) {
  const Progress silent;
  TaskContext task(threads, silent, 0);
  return make_leaves(mesh.positions_view(), EdgeSource(mesh.view().faces), make_frame(mesh.positions_view()), task);
}

class LeavesOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(LeavesOfFamilies, EveryVertexHasOneSlotAndLeavesHold1To32) {
  std::size_t leaf_count = 0;
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 2, vertices);
    const LeafPartition leaves = leaves_of(mesh);
    ASSERT_EQ(leaves.slot.size(), mesh.size());
    ASSERT_EQ(leaves.permutation.size(), mesh.size());
    ASSERT_EQ(leaves.leaf_begin.front(), 0U);
    ASSERT_EQ(leaves.leaf_begin.back(), mesh.size());
    for (std::size_t leaf = 0; leaf + 1 < leaves.leaf_begin.size(); ++leaf) {
      const std::size_t size = leaves.leaf_begin[leaf + 1] - leaves.leaf_begin[leaf];
      ASSERT_EQ(size > 0, leaf % kFanOut < leaves.forest.records[leaf / kFanOut].nodes)
          << "at the first places of a group";
      ASSERT_LE(size, kLeafCapacity);
      for (std::size_t lane = 0; lane < size; ++lane) {
        const VertexId v = leaves.permutation[leaves.leaf_begin[leaf] + lane];
        ASSERT_EQ(leaves.slot[v], leaf * kLeafCapacity + lane);
        ASSERT_TRUE(lane == 0 || v > leaves.permutation[leaves.leaf_begin[leaf] + lane - 1]) << "in the caller's order";
      }
      leaf_count += static_cast<std::size_t>(size > 0);
    }
  }
  std::printf("%s: %zu leaves\n", std::string(GetParam().name).c_str(), leaf_count);
}

INSTANTIATE_TEST_SUITE_P(Leaves, LeavesOfFamilies, testing::ValuesIn(families()), family_name);

/// The mean radius of the bounding spheres of `count` consecutive leaves.
double mean_radius(const TestMesh& mesh, const LeafPartition& leaves, std::size_t count) {
  double sum = 0;
  std::size_t runs = 0;
  for (std::size_t leaf = 0; leaf + count < leaves.leaf_begin.size(); leaf += count) {
    std::vector<double> xyz;
    for (std::size_t i = leaves.leaf_begin[leaf]; i < leaves.leaf_begin[leaf + count]; ++i) {
      const auto p = mesh.positions.begin() + 3 * static_cast<std::ptrdiff_t>(leaves.permutation[i]);
      xyz.insert(xyz.end(), p, p + 3);
    }
    if (xyz.empty()) continue;
    sum += bounding_sphere(std::span<const double>(xyz)).radius;
    ++runs;
  }
  return sum / static_cast<double>(runs);
}

TEST(Leaves, LieCloseTogetherAloneAndInRunsOf8And64) {
  const TestMesh mesh = bumpy_grid(200);
  const LeafPartition leaves = leaves_of(mesh);
  // The half diagonals of squares of 30, 240 and 1920 unit cells.
  EXPECT_LT(mean_radius(mesh, leaves, 1), 1.4 * 3.9);
  EXPECT_LT(mean_radius(mesh, leaves, 8), 1.4 * 11);
  EXPECT_LT(mean_radius(mesh, leaves, 64), 1.4 * 31);
}

TEST(Leaves, OfASurfaceAreNearlyFull) {
  const TestMesh mesh = bumpy_grid(200);
  const LeafPartition leaves = leaves_of(mesh);
  std::size_t count = 0;
  for (const GroupRecord& group : std::span(leaves.forest.records).first(leaves.forest.levels[1])) count += group.nodes;
  EXPECT_GT(static_cast<double>(mesh.size()) / static_cast<double>(count), 28);
  EXPECT_GT(static_cast<double>(count), 0.9 * static_cast<double>(leaves.leaf_begin.size() - 1)) << "of the places";
}

TEST(Leaves, OfSurfacesAreConnectedAndHoldNoOtherComponent) {
  // Two sheets so close that cells hold vertices of both, and points near them: a leaf has no vertices that only an
  // edge outside the leaf could connect.
  TestMesh mesh = make_grid(90, 90, false);
  TestMesh upper = make_grid(90, 90, false);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] = 0.01;
  append(mesh, upper);
  Random random(4);
  for (int i = 0; i < 50; ++i) mesh.add_vertex(random.uniform(0, 90), random.uniform(0, 90), 0.005);
  const LeafPartition leaves = leaves_of(mesh.finish(true));
  constexpr VertexId kSheet = 90 * 90;
  for (std::size_t leaf = 0; leaf + 1 < leaves.leaf_begin.size(); ++leaf) {
    for (std::size_t i = leaves.leaf_begin[leaf]; i < leaves.leaf_begin[leaf + 1]; ++i) {
      EXPECT_EQ(leaves.permutation[i] / kSheet, leaves.permutation[leaves.leaf_begin[leaf]] / kSheet)
          << "leaf " << leaf;
    }
  }
}

TEST(Leaves, AreTheSameForAnyNumberOfThreads) {
  const TestMesh mesh = bumpy_grid(150);
  const LeafPartition expected = leaves_of(mesh);
  for (const unsigned threads : {2U, 5U}) {
    const LeafPartition leaves = leaves_of(mesh, threads);
    EXPECT_EQ(leaves.slot, expected.slot);
    EXPECT_EQ(leaves.permutation, expected.permutation);
    EXPECT_EQ(leaves.leaf_begin, expected.leaf_begin);
  }
}

TEST(Leaves, SlotsOfTheLargestNumberOfLeavesHave32Bits) {
  check_leaf_count(kMaxLeaves);
  EXPECT_EQ(std::uint64_t{kMaxLeaves} * kLeafCapacity, std::uint64_t{1} << 32U);
  expect_refused(ErrorCode::TooLarge, "134217729 leaves in the index, but the limit is 134217728",
                 [] { check_leaf_count(kMaxLeaves + 1); });
}

}  // namespace
}  // namespace meshhood::test
