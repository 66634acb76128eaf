// SPDX-License-Identifier: MIT
// The quality of an index: what a build would gain, compared with what it gains.
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/refit.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"

namespace meshhood::test {
namespace {

/// The mean radius of the leaves, divided by that after a build.
double real_gain(const Index& index, const TestMesh& mesh) {
  return index.levels()[0].mean_radius / build(mesh.view()).levels()[0].mean_radius;
}

MESHHOOD_SUITE_OF_FAMILIES(QualityFamilies);

TEST_P(QualityFamilies, OfANewIndexIsGood) {
  // The sample is then the whole mesh.
  const TestMesh mesh = make_mesh(GetParam(), 3, 900);
  const Quality found = quality(build(mesh.view()));
  std::printf("gain %.2f, mean radius %g, of new leaves %g\n", found.gain, found.mean_radius, found.rebuilt_radius);
  EXPECT_GT(found.gain, 0.8);
  EXPECT_LT(found.gain, 1.3);
}

TEST(Quality, DoesNotChangeWithPositionAndSize) {
  TestMesh mesh = bumpy_grid(100);
  const Index index = build(mesh.view());
  const Quality before = quality(index);
  for (double& x : mesh.positions) x = 64 * x + 4096;
  mesh.finish(true);
  const Quality after = quality(refit(index, mesh.positions_view()));
  EXPECT_NEAR(after.gain, before.gain, 0.02);
  EXPECT_NEAR(after.mean_radius, 64 * before.mean_radius, 64 * 0.02 * before.mean_radius);
}

TEST(Quality, PredictsTheGainOfABuildWhereLeavesAreStretchedOrTorn) {
  const auto [mesh, index] = indexed(bumpy_grid(150));
  for (const double stretch : {2.0, 4.0, 8.0}) {
    TestMesh moved = mesh;
    for (std::size_t i = 0; i < moved.positions.size(); i += 3) moved.positions[i] *= stretch;
    moved.finish(true);
    const Index refitted = refit(index, moved.positions_view());
    const double found = quality(refitted).gain;
    const double real = real_gain(refitted, moved);
    std::printf("stretched by %g: gain %.2f, in fact %.2f\n", stretch, found, real);
    EXPECT_NEAR(found, real, 0.25 * real);
  }
}

TEST(Quality, IsLargeForTornLeaves) {
  const TestMesh mesh = bumpy_grid(150);
  TestMesh torn = mesh;
  Random random(1);
  const std::vector<std::uint32_t> place = random.permutation(mesh.size());
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) torn.positions[3 * v + axis] = mesh.positions[3 * place[v] + axis];
  }
  torn.finish(true);
  const Index refitted = refit(build(mesh.view()), torn.positions_view());
  const double found = quality(refitted).gain;
  const double real = real_gain(refitted, torn);
  std::printf("torn: gain %.2f, in fact %.2f\n", found, real);
  EXPECT_GT(found, 1.5);
}

TEST(Quality, IsLargeWhereAVertexWasFarAwayBecauseTheFrameIsStillThatLarge) {
  const auto [mesh, index] = indexed(bumpy_grid(100));
  TestMesh far = mesh;
  far.positions[0] = 1e9;
  far.finish(true);
  const std::vector<VertexId> changed{0};
  const Index back = refit(refit(index, far.positions_view(), changed), mesh.positions_view(), changed);
  EXPECT_NEAR(quality(index).gain, 1, 0.3);
  EXPECT_GT(quality(back).gain, 10);
}

TEST(Quality, OfAMeshWithoutVerticesHasTheGainOne) {
  const TestMesh mesh;
  EXPECT_EQ(quality(build(mesh.view())).gain, 1);
}

}  // namespace
}  // namespace meshhood::test
