// SPDX-License-Identifier: MIT
#include "meshhood/cgal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "adapters/adapter_case.h"

namespace meshhood::test {
namespace {

template <class Kernel>
class CgalMesh : public testing::Test {
 protected:
  using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;
  using Vertex = typename Mesh::Vertex_index;

  static Mesh make() {
    Mesh mesh;
    for (const auto& p : adapter_points()) mesh.add_vertex({p[0], p[1], p[2]});
    for (const auto& face : adapter_faces()) {
      std::vector<Vertex> corners;
      for (const std::uint32_t v : face) corners.emplace_back(v);
      mesh.add_face(corners);
    }
    return mesh;
  }
};

using Kernels = testing::Types<CGAL::Simple_cartesian<double>, CGAL::Simple_cartesian<float>,
                               CGAL::Exact_predicates_exact_constructions_kernel>;
TYPED_TEST_SUITE(CgalMesh, Kernels);

TYPED_TEST(CgalMesh, IsCopiedWithItsIds) { expect_adapter_mesh(copy_mesh(this->make())); }

TYPED_TEST(CgalMesh, DeformsWithTheIndex) {
  auto mesh = this->make();
  const MeshData before = copy_mesh(mesh);
  mesh.point(typename TestFixture::Vertex(2)) = {5, 6, 7};
  const std::vector<double> positions = copy_positions(mesh);
  const MeshData after = copy_mesh(mesh);
  EXPECT_THAT(refit(build(before.view()), positions).check(after.view()), testing::IsEmpty());
}

TYPED_TEST(CgalMesh, WithRemovedVerticesIsRefusedUntilItsGarbageIsCollected) {
  auto mesh = this->make();
  mesh.remove_vertex(mesh.add_vertex({1, 2, 3}));
  expect_refused(ErrorCode::InvalidMesh, "has 1 removed vertices: call collect_garbage() first",
                 [&] { return copy_mesh(mesh); });
  mesh.collect_garbage();
  expect_adapter_mesh(copy_mesh(mesh));
}

TYPED_TEST(CgalMesh, HasEdgesWithoutFaces) {
  auto mesh = this->make();
  mesh.add_edge(typename TestFixture::Vertex(3), typename TestFixture::Vertex(6));
  const MeshData copy = copy_mesh(mesh);
  const Adjacency graph = adjacency(copy.view());
  EXPECT_THAT(graph.view()[6], testing::ElementsAre(3));
}

}  // namespace
}  // namespace meshhood::test
