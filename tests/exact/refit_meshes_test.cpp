// SPDX-License-Identifier: MIT
// Exact answers on real meshes whose vertices have moved.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/refit.h"

#include "support/exact_answer.h"
#include "support/scale.h"
#include "support/shared_meshes.h"

namespace meshhood::test {
namespace {

std::vector<double> copy_positions(const MeshView& mesh) {
  std::vector<double> xyz;
  mesh.positions.visit([&](const auto& all) {
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) xyz.push_back(static_cast<double>(all(v, axis)));
    }
  });
  return xyz;
}

/// Twists the mesh around its first axis, `turns` times over its length.
std::vector<double> twisted(std::vector<double> xyz, double turns) {
  double low = xyz[0];
  double high = xyz[0];
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    low = std::min(low, xyz[i]);
    high = std::max(high, xyz[i]);
  }
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const double angle = 6.2831853 * turns * (xyz[i] - low) / (high - low);
    const double y = xyz[i + 1];
    const double z = xyz[i + 2];
    xyz[i + 1] = std::cos(angle) * y - std::sin(angle) * z;
    xyz[i + 2] = std::sin(angle) * y + std::cos(angle) * z;
  }
  return xyz;
}

class RefitMeshes : public testing::TestWithParam<const char*> {};

TEST_P(RefitMeshes, AnswersAreThoseOfTheReference) {
  MESHHOOD_NEED_SHARED_MESHES();
  const io::Mesh mesh = shared_mesh(GetParam());
  const Index index = build(mesh.view());
  for (const double turns : {0.1, 1.0, 10.0}) {
    const std::vector<double> moved = twisted(copy_positions(mesh.view()), turns);
    const MeshView view{moved, mesh.view().faces};
    ExactAnswer exact(view, refit(index, moved));
    const double mean_edge = mean_edge_length(exact.graph());
    const std::size_t step = std::max<std::size_t>(1, index.vertex_count() / scaled(1000, 50));
    for (std::size_t v = 0; v < index.vertex_count(); v += step) {
      for (const double edges : {1, 3, 10, 30}) exact.query_ids(static_cast<VertexId>(v), edges * mean_edge);
    }
    EXPECT_EQ(exact.mismatches(), 0U);
    std::printf("%s: %g turns, gain %.2f, %zu queries\n", GetParam(), turns, quality(exact.index()).gain,
                exact.queries());
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, RefitMeshes,
                         testing::Values("paper/tosca_cat0.off", "paper/tosca_victoria0.off",
                                         "scan/cortex_left_41k.ply.zst"),
                         shared_mesh_case);

}  // namespace
}  // namespace meshhood::test
