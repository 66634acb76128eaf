// SPDX-License-Identifier: MIT
#include "meshhood/openmesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <gtest/gtest.h>

#include "adapters/adapter_case.h"

namespace meshhood::test {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};

template <class Mesh>
Mesh make() {
  Mesh mesh;
  for (const auto& p : adapter_points()) {
    mesh.add_vertex(OpenMesh::vector_cast<typename Mesh::Point>(OpenMesh::Vec3d(p[0], p[1], p[2])));
  }
  for (const auto& face : adapter_faces()) {
    std::vector<OpenMesh::VertexHandle> corners;
    corners.reserve(face.size());
    for (const std::uint32_t v : face) corners.emplace_back(static_cast<int>(v));
    mesh.add_face(corners);
  }
  return mesh;
}

using SingleMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

TEST(OpenMeshMesh, IsCopiedWithItsIdsInItsPrecision) {
  const MeshData single = copy_mesh(make<SingleMesh>());
  expect_adapter_mesh(single);
  EXPECT_TRUE(std::holds_alternative<std::vector<float>>(single.positions));
  const MeshData twice = copy_mesh(make<DoubleMesh>());
  expect_adapter_mesh(twice);
  EXPECT_TRUE(std::holds_alternative<std::vector<double>>(twice.positions));
}

TEST(OpenMeshMesh, OfTrianglesIsCopied) {
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  for (const float x : {0.F, 1.F, 2.F}) mesh.add_vertex({x, x * x, 0});
  mesh.add_face(OpenMesh::VertexHandle(2), OpenMesh::VertexHandle(0), OpenMesh::VertexHandle(1));
  const MeshData copy = copy_mesh(mesh);
  EXPECT_THAT(copy.corners, testing::UnorderedElementsAre(0, 1, 2));
  EXPECT_THAT(copy.offsets, testing::ElementsAre(0, 3));
}

TEST(OpenMeshMesh, DeformsWithTheIndex) {
  auto mesh = make<SingleMesh>();
  const MeshData before = copy_mesh(mesh);
  mesh.set_point(OpenMesh::VertexHandle(2), {5, 6, 7});
  const std::vector<float> positions = copy_positions(mesh);
  const MeshData after = copy_mesh(mesh);
  EXPECT_THAT(refit(build(before.view()), positions).check(after.view()), testing::IsEmpty());
}

TEST(OpenMeshMesh, WithDeletedVerticesIsRefusedUntilItsGarbageIsCollected) {
  auto mesh = make<SingleMesh>();
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  const OpenMesh::VertexHandle extra(mesh.add_vertex({1, 2, 3}).idx());
  expect_adapter_mesh([&] {
    mesh.delete_vertex(extra);
    expect_refused(ErrorCode::InvalidMesh, "has deleted vertices: call garbage_collection() first",
                   [&] { return copy_mesh(mesh); });
    mesh.garbage_collection();
    return copy_mesh(mesh);
  }());
}

}  // namespace
}  // namespace meshhood::test
