// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/mesh_data.h"
#include "meshhood/refit.h"

#include "support/refusal.h"

/// One mesh for the tests of all adapters: a strip of a quad and two triangles.
namespace meshhood::test {

inline const std::vector<std::array<double, 3>>& adapter_points() {
  static const std::vector<std::array<double, 3>> points{{0, 0, 0},   {1, 0, 0.25},  {2, 0.5, 0}, {2, 1, 0},
                                                         {1, 1, 0.5}, {0, 1, 0.125}, {9, 9, 9}};
  return points;
}

inline const std::vector<std::vector<std::uint32_t>>& adapter_faces() {
  static const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 4, 5}, {1, 2, 4}, {2, 3, 4}};
  return faces;
}

/// The numbers of the points and the graph are those of the mesh above. Vertex 6 is isolated.
inline void expect_adapter_mesh(const MeshData& mesh) {
  const MeshView view = mesh.view();
  ASSERT_EQ(view.positions.size(), adapter_points().size());
  view.positions.visit([&](const auto& xyz) {
    for (std::size_t v = 0; v < view.positions.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(xyz(v, axis), adapter_points()[v][axis]);
    }
  });
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint32_t> corners;
  for (const auto& face : adapter_faces()) {
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(corners.size());
  }
  EXPECT_THAT(build(view).check({view.positions, FacesView::polygons(offsets, corners)}), testing::IsEmpty());
}

}  // namespace meshhood::test
