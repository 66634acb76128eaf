// SPDX-License-Identifier: MIT
// The data sets of the paper's section 4, or stand-ins.
#include <cstdio>
#include <string>

#include "support/real_mesh.h"
#include "support/scale.h"
#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

class PaperMeshes : public testing::TestWithParam<const char*> {};

TEST_P(PaperMeshes, AnswersLieBetweenExactAndBall) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam());
  RealMesh real(mesh.view());
  Random random(1);
  for (const double edges : {2, 5, 10, 20, 40, 65, 90}) real.query(edges, scaled(500, 10), random);
  const auto& [queries, exact, extra, mismatches] = real.tally();
  std::printf(
      "%s: %zu vertices, %zu queries, %zu vertices in exact answers, %.3f %% more in the paper's, %zu mismatches\n",
      GetParam(), mesh.view().positions.size(), queries, exact,
      100 * static_cast<double>(extra) / static_cast<double>(exact), mismatches);
  EXPECT_EQ(mismatches, 0U);
}

TEST_P(PaperMeshes, IndexIsAtMostThreeFifthsOfTheMesh) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam(), {.precision = io::Precision::Float});
  const MeshView view = mesh.view();
  const double mesh_bytes = 12.0 * static_cast<double>(view.positions.size() + view.faces.size());
  const double ratio = static_cast<double>(paper::build(view).bytes().total()) / mesh_bytes;
  std::printf("%s: index %.3f of the mesh\n", GetParam(), ratio);
  EXPECT_LE(ratio, 0.60);
}

INSTANTIATE_TEST_SUITE_P(Meshes, PaperMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_victoria0.off",
                                         "paper/stanford_dragon_437k.ply.zst", "paper/head_skin_1m.ply.zst",
                                         "paper/mri_head_a_1m.ply.zst"),
                         shared_mesh_case);

}  // namespace
}  // namespace meshhood::test
