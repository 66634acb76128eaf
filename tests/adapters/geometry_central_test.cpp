// SPDX-License-Identifier: MIT
#include "meshhood/geometry_central.h"

#include <geometrycentral/surface/surface_mesh.h>
#include <geometrycentral/surface/vertex_position_geometry.h>
#include <gtest/gtest.h>

#include "adapters/adapter_case.h"

namespace meshhood::test {
namespace {

namespace gc = geometrycentral;

/// The faces, and two around an additional vertex, because this library has no isolated vertices.
struct GcMesh {
  std::unique_ptr<gc::surface::SurfaceMesh> surface;
  gc::surface::VertexData<gc::Vector3> positions;

  GcMesh() {
    std::vector<std::vector<std::size_t>> faces{{3, 2, 6}};
    for (const auto& face : adapter_faces()) faces.emplace_back(face.begin(), face.end());
    surface = std::make_unique<gc::surface::SurfaceMesh>(faces);
    positions = gc::surface::VertexData<gc::Vector3>(*surface);
    for (std::size_t v = 0; v < adapter_points().size(); ++v) {
      const auto& p = adapter_points()[v];
      positions[v] = {p[0], p[1], p[2]};
    }
  }
};

TEST(GeometryCentralMesh, IsCopiedWithItsIds) {
  GcMesh mesh;
  const MeshData copy = copy_mesh(*mesh.surface, mesh.positions);
  ASSERT_EQ(copy.view().positions.size(), adapter_points().size());
  std::vector<std::uint64_t> offsets{0, 3};
  std::vector<std::uint32_t> corners{3, 2, 6};
  for (const auto& face : adapter_faces()) {
    corners.insert(corners.end(), face.begin(), face.end());
    offsets.push_back(corners.size());
  }
  const MeshView expected{copy.view().positions, FacesView::polygons(offsets, corners)};
  EXPECT_THAT(build(copy.view()).check(expected), testing::IsEmpty());
  EXPECT_EQ(std::get<std::vector<double>>(copy.positions)[7], 0.5);
}

TEST(GeometryCentralMesh, DeformsWithTheIndex) {
  GcMesh mesh;
  gc::surface::VertexPositionGeometry geometry(*mesh.surface, mesh.positions);
  const MeshData before = copy_mesh(*mesh.surface, geometry.inputVertexPositions);
  geometry.inputVertexPositions[mesh.surface->vertex(2)] = {5, 6, 7};
  const std::vector<double> positions = copy_positions(*mesh.surface, geometry.inputVertexPositions);
  const MeshData after = copy_mesh(*mesh.surface, geometry.inputVertexPositions);
  EXPECT_THAT(refit(build(before.view()), positions).check(after.view()), testing::IsEmpty());
}

}  // namespace
}  // namespace meshhood::test
