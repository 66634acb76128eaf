// SPDX-License-Identifier: MIT
// Faces, submeshes and rims of regions of real meshes, against passes over all faces.
#include <cstdio>

#include <gtest/gtest.h>

#include "support/draw_start.h"
#include "support/each_shared_mesh.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "support/submesh_checks.h"

namespace meshhood::test {
namespace {

class RealSubmeshes : public testing::TestWithParam<const char*> {};

TEST_P(RealSubmeshes, HaveTheFacesOfTheirVerticesAndTheirRim) {
  MESHHOOD_NEED_SHARED_MESHES();
  std::size_t regions = 0;
  const std::size_t meshes = for_each_shared_mesh(GetParam(), [&](const TestMesh& mesh) {
    const RegionOracle oracle(mesh);
    const double mean_edge = oracle.graph().mean_edge();
    const Surface surface(build(mesh.view()), mesh.view());
    Random random(5);
    for (std::size_t i = 0; i < scaled(20, 2) && !HasFailure(); ++i, ++regions) {
      PlainStart start;
      start.seeds = {static_cast<VertexId>(random.below(mesh.size()))};
      start.center = position(mesh, start.seeds[0]);
      for (double& x : start.center) x += 0.4 * mean_edge * random.uniform(-1, 1);
      start.walls = draw_mask(random, mesh.size(), i % 2 == 0 ? 0 : 12);
      start.ignored.assign(mesh.size(), 0);
      const double radius = mean_edge * random.uniform(0, 12);
      const FoundRegion region{mesh, surface, start, radius, oracle.region(start, radius)};
      expect_faces_of_vertices(region);
      expect_rim_of_segments(region);
      expect_rim_at_radius(region);
    }
  });
  std::printf("%s: %zu meshes, %zu regions\n", GetParam(), meshes, regions);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealSubmeshes, shared_folders(), shared_folder_case);

}  // namespace
}  // namespace meshhood::test
