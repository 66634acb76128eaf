// SPDX-License-Identifier: MIT
// Faces, submeshes and rims of regions, against passes over all faces of small meshes of every kind.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/surface.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"
#include "support/submesh_checks.h"
#include "surface/surface.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Submeshes : public testing::TestWithParam<Family> {
 protected:
  /// Calls `f(region)` for regions of meshes of many sizes.
  template <class F>
  void for_each_region(F&& f) {
    std::size_t count = 0;
    for (const std::size_t vertices : {2U, 9U, 60U, 300U}) {
      const TestMesh mesh = make_mesh(GetParam(), vertices + 1, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(mesh.name);
      const RegionOracle oracle(mesh);
      const Surface surface(build(mesh.view()), mesh.view());
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(10, 3) && !HasFailure(); ++i, ++count) {
        PlainStart start = draw_start(random, mesh).plain;
        start.ignored.assign(mesh.size(), 0);
        const double radius = oracle.distance(start, random.below(mesh.size()));
        f(FoundRegion{mesh, surface, start, radius, oracle.region(start, radius)});
      }
    }
    std::printf("%s: %zu regions\n", std::string(GetParam().name).c_str(), count);
  }
};

TEST_P(Submeshes, HaveTheFacesOfTheirVertices) { for_each_region(expect_faces_of_vertices); }

TEST_P(Submeshes, HaveARimOfTheSegmentsOfTheirFaces) { for_each_region(expect_rim_of_segments); }

TEST_P(Submeshes, HaveARimAtTheRadius) { for_each_region(expect_rim_at_radius); }

INSTANTIATE_TEST_SUITE_P(All, Submeshes, testing::ValuesIn(families()), family_name);

TEST(Rim, OfABallOnAGridIsOneLoopWithTheRegionOnItsLeft) {
  const TestMesh mesh = make_grid(11, 11, false);
  const RegionOracle oracle(mesh);
  const PlainStart start{{5, 5, 0}, {60}, std::vector<std::uint8_t>(121), std::vector<std::uint8_t>(121)};
  const Surface surface(build(mesh.view()), mesh.view());
  const Rim rim = surface.rim(oracle.region(start, 3.3), start.center, 3.3);
  ASSERT_THAT(rim.closed, ElementsAre(1));
  double area = 0;
  for (std::size_t i = 0; i < rim.points.size(); ++i) {
    const SpacePoint& p = rim.points[i];
    const SpacePoint& q = rim.points[(i + 1) % rim.points.size()];
    area += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  // Whether the faces run counterclockwise, seen from above.
  const auto a = position(mesh, mesh.face(0)[0]);
  const auto b = position(mesh, mesh.face(0)[1]);
  const auto c = position(mesh, mesh.face(0)[2]);
  const double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  EXPECT_GT(area * turn, 0);
  EXPECT_NEAR(std::abs(area), 3.3 * 3.3 * 3.14159, 2);
}

TEST(Rim, EndsAtTheBorderOfTheMesh) {
  const TestMesh mesh = make_grid(6, 6, false);
  const Surface surface(build(mesh.view()), mesh.view());
  const Rim rim = surface.rim(std::array<VertexId, 3>{0, 1, 6}, {0, 0, 0}, 1.0);
  ASSERT_THAT(rim.closed, ElementsAre(0));
  EXPECT_EQ(rim.edges.front()[0] + rim.edges.back()[0], 7U);
}

TEST(Rim, SplitsAtANonManifoldEdge) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(2, 0, 0);
  for (const double y : {1.0, -1.0, 0.5}) mesh.add_face({0, 1, mesh.add_vertex(0.1, y, y * y)});
  mesh.finish(false);
  const Surface surface(build(mesh.view()), mesh.view());
  const Rim rim = surface.rim(std::array<VertexId, 1>{0}, {0, 0, 0}, 0.25);
  EXPECT_THAT(rim.closed, ElementsAre(0, 0, 0));
  EXPECT_EQ(rim.points.size(), 6U);
}

TEST(Rim, OfTheWholeMeshIsEmpty) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Surface surface(build(mesh.view()), mesh.view());
  const std::vector<VertexId> all{0, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_THAT(surface.rim(all, {0, 0, 0}, kInfinity).points, IsEmpty());
}

TEST(ExitPoint, IsExactForExactNumbers) {
  const Point p = exit_point({1, 0, 0}, {5, 0, 0}, {0, 0, 0}, 3);
  EXPECT_EQ(p.x, 3);
  EXPECT_EQ(exit_point({3, 0, 0}, {5, 0, 0}, {0, 0, 0}, 3).x, 3) << "the inner end lies at the radius";
  EXPECT_EQ(exit_point({1, 0, 0}, {2, 0, 0}, {0, 0, 0}, 3).x, 2) << "the outer end lies inside";
  EXPECT_EQ(exit_point({0x1p499, 0, 0}, {0x1p500, 0, 0}, {0, 0, 0}, 0x1.8p499).x, 0x1.8p499);
  EXPECT_EQ(exit_point({0x1p-900, 0, 0}, {0x1p-800, 0, 0}, {0, 0, 0}, 0).x, 0x1p-800) << "squares underflow";
}

TEST(Submesh, RefusesInvalidArguments) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Surface surface(build(mesh.view()), mesh.view());
  const std::array<VertexId, 2> wrong{0, 9};
  expect_refused(ErrorCode::VertexOutOfRange, "ids: position 1: vertex 9", [&] { return surface.faces(wrong); });
  const std::array<VertexId, 1> far{8};
  expect_refused(ErrorCode::InvalidOption, "vertex 8 is not within the radius 1",
                 [&] { return surface.rim(far, {0, 0, 0}, 1); });
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { return surface.rim(far, {0, 0, 0}, -1); });
  expect_refused(ErrorCode::InvalidOption, "center: coordinate 0 is inf",
                 [&] { return surface.rim(far, {kInfinity, 0, 0}, 1); });
  const std::vector<std::uint32_t> corners{0, 0, 9};
  expect_refused(ErrorCode::InvalidMesh, "face 0", [&] { Surface(build(mesh.view()), FacesView::triangles(corners)); });
}

}  // namespace
}  // namespace meshhood::test
