// SPDX-License-Identifier: MIT
// The indexes of real meshes. Answers on them: query_meshes_test.cpp and tools/verify.
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"

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

INSTANTIATE_TEST_SUITE_P(Meshes, RealMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_cat2.off", "paper/tosca_victoria0.off",
                                         "scan/cortex_left_41k.ply.zst", "paper/stanford_dragon_437k.ply.zst",
                                         "paper/head_skin_1m.ply.zst", "paper/mri_head_a_1m.ply.zst"),
                         shared_mesh_case);

}  // namespace
}  // namespace meshhood::test
