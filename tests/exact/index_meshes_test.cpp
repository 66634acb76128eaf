// SPDX-License-Identifier: MIT
// The indexes of real meshes, among them the data sets of the paper's section 4, or stand-ins. Answers on them:
// whole/all_meshes_test.cpp and tools/verify.
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/paper.h"

#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

class RealMeshes : public testing::TestWithParam<const char*> {};

TEST_P(RealMeshes, IndexIsSoundAndTakesAtMost34BytesAVertex) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam(), {.precision = io::Precision::Float});
  const Index index = build(mesh.view());
  const double per_vertex = static_cast<double>(index.bytes().total()) / static_cast<double>(index.vertex_count());
  std::printf("%s: %.2f bytes a vertex\n", GetParam(), per_vertex);
  EXPECT_LE(per_vertex, 35);
  EXPECT_THAT(index.check(mesh.view()), testing::IsEmpty());
}

TEST_P(RealMeshes, IndexOfThePaperIsAtMostThreeFifthsOfTheMesh) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam(), {.precision = io::Precision::Float});
  const MeshView view = mesh.view();
  const double mesh_bytes = 12.0 * static_cast<double>(view.positions.size() + view.faces.size());
  const double ratio = static_cast<double>(paper::build(view).bytes().total()) / mesh_bytes;
  std::printf("%s: index %.3f of the mesh\n", GetParam(), ratio);
  EXPECT_LE(ratio, 0.60);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RealMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_cat2.off", "paper/tosca_victoria0.off",
                                         "scan/cortex_left_41k.ply.zst", "paper/stanford_dragon_437k.ply.zst",
                                         "paper/head_skin_1m.ply.zst", "paper/mri_head_a_1m.ply.zst"),
                         shared_mesh_case);

}  // namespace
}  // namespace meshhood::test
