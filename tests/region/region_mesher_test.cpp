// SPDX-License-Identifier: MIT
// Faces, submeshes and rims of regions, against passes over all faces of small meshes of every kind and
// of real ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/region_mesh.h"

#include "region/exit_point.h"
#include "support/draw_start.h"
#include "support/each_shared_mesh.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/refusal.h"
#include "support/region_oracle.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using MeshEdge = std::array<VertexId, 2>;
using EdgePair = std::pair<MeshEdge, MeshEdge>;

EdgePair undirected(const MeshEdge& a, const MeshEdge& b) { return {std::min(a, b), std::max(a, b)}; }

/// For each face: where its boundary leaves the region, and where it last entered it before that.
std::multiset<EdgePair> segments_of_all_faces(const TestMesh& mesh, const std::set<VertexId>& region) {
  std::multiset<EdgePair> segments;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::size_t size = face.size();
    for (std::size_t i = 0; size >= 3 && i < size; ++i) {
      const MeshEdge leaving{face[i], face[(i + 1) % size]};
      if (!region.contains(leaving[0]) || region.contains(leaving[1])) continue;
      std::size_t entry = i;
      while (region.contains(face[(entry + size - 1) % size])) entry = (entry + size - 1) % size;
      const MeshEdge entering{face[entry], face[(entry + size - 1) % size]};
      if (leaving != entering) segments.insert(undirected(leaving, entering));
    }
  }
  return segments;
}

std::multiset<EdgePair> segments_of_rim(const Rim& rim) {
  std::multiset<EdgePair> segments;
  for (std::size_t line = 0; line < rim.size(); ++line) {
    for (std::size_t i = rim.offsets[line]; i < rim.offsets[line + 1]; ++i) {
      const bool is_last = i + 1 == rim.offsets[line + 1];
      if (is_last && rim.closed[line] == 0) continue;
      segments.insert(undirected(rim.edges[i], rim.edges[is_last ? rim.offsets[line] : i + 1]));
    }
  }
  return segments;
}

/// A region of a mesh, found by the oracle.
struct FoundRegion {
  const TestMesh& mesh;
  RegionMesher& mesher;
  PlainStart start;
  double radius;
  std::vector<VertexId> ids;
};

void expect_faces_of_vertices(const FoundRegion& region) {
  const auto& [mesh, mesher, start, radius, ids] = region;
  const auto is_in = [&all_ids = ids](VertexId v) { return std::binary_search(all_ids.begin(), all_ids.end(), v); };
  std::vector<std::size_t> all;
  std::vector<std::size_t> any;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (!face.empty() && std::all_of(face.begin(), face.end(), is_in)) all.push_back(f);
    if (std::any_of(face.begin(), face.end(), is_in)) any.push_back(f);
  }
  ASSERT_EQ(mesher.faces(ids), all);
  ASSERT_EQ(mesher.faces(ids, Corners::Any), any);
  for (const auto& [corners, faces] : {std::pair(Corners::All, all), std::pair(Corners::Any, any)}) {
    const Submesh part = mesher.submesh(ids, corners);
    ASSERT_EQ(part.faces, faces);
    ASSERT_EQ(part.offsets.size(), faces.size() + 1);
    std::set<VertexId> used;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      std::vector<VertexId> face;
      for (std::size_t k = part.offsets[i]; k < part.offsets[i + 1]; ++k) {
        face.push_back(part.vertices.at(part.corners[k]));
      }
      ASSERT_THAT(face, testing::ElementsAreArray(mesh.face(faces[i])));
      used.insert(face.begin(), face.end());
    }
    ASSERT_THAT(part.vertices, testing::ElementsAreArray(used));
  }
}

void expect_rim_of_segments(const FoundRegion& region) {
  const Rim rim = region.mesher.rim(region.ids, region.start.center, region.radius);
  ASSERT_EQ(rim.points.size(), rim.edges.size());
  ASSERT_EQ(rim.offsets.size(), rim.size() + 1);
  const std::multiset<EdgePair> segments = segments_of_rim(rim);
  ASSERT_EQ(segments, segments_of_all_faces(region.mesh, {region.ids.begin(), region.ids.end()}));
  std::map<MeshEdge, int> degree;
  for (const auto& [a, b] : segments) {
    ++degree[a];
    ++degree[b];
  }
  for (std::size_t line = 0; line < rim.size(); ++line) {
    for (std::size_t i = rim.offsets[line]; i < rim.offsets[line + 1]; ++i) {
      const bool is_end = i == rim.offsets[line] || i + 1 == rim.offsets[line + 1];
      ASSERT_EQ(degree[rim.edges[i]] != 2, is_end && rim.closed[line] == 0);
    }
  }
}

void expect_rim_at_radius(const FoundRegion& region) {
  const auto& [mesh, mesher, start, radius, ids] = region;
  const Rim rim = mesher.rim(ids, start.center, radius);
  for (std::size_t i = 0; i < rim.points.size(); ++i) {
    const auto a = position(mesh, rim.edges[i][0]);
    const auto b = position(mesh, rim.edges[i][1]);
    const auto from_center = [&center = start.center](const SpacePoint& p) {
      return std::hypot(p[0] - center[0], p[1] - center[1], p[2] - center[2]);
    };
    const bool ends_at_a_wall = start.walls[rim.edges[i][1]] != 0 && from_center(b) <= radius;
    double scale = radius;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scale = std::max({scale, std::abs(a[axis]), std::abs(b[axis]), std::abs(start.center[axis])});
      const auto [low, high] = std::minmax(a[axis], b[axis]);
      ASSERT_GE(rim.points[i][axis], low - 1e-14 * scale);
      ASSERT_LE(rim.points[i][axis], high + 1e-14 * scale);
    }
    if (ends_at_a_wall) {
      ASSERT_EQ(rim.points[i], b);
    } else {
      // Where squares underflow, the predicate takes small distances for 0.
      ASSERT_NEAR(from_center(rim.points[i]), radius, 1e-14 * scale + 1e-160);
    }
  }
}

class RegionMeshes : public testing::TestWithParam<Family> {
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
      RegionMesher mesher(mesh.view());
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(10, 3) && !HasFailure(); ++i, ++count) {
        PlainStart start = draw_start(random, mesh).plain;
        start.ignored.assign(mesh.size(), 0);
        const double radius = oracle.distance(start, random.below(mesh.size()));
        f(FoundRegion{mesh, mesher, start, radius, oracle.region(start, radius)});
      }
    }
    std::printf("%s: %zu regions\n", std::string(GetParam().name).c_str(), count);
  }
};

TEST_P(RegionMeshes, HaveTheFacesOfTheirVertices) { for_each_region(expect_faces_of_vertices); }

TEST_P(RegionMeshes, HaveARimOfTheSegmentsOfTheirFaces) { for_each_region(expect_rim_of_segments); }

TEST_P(RegionMeshes, HaveARimAtTheRadius) { for_each_region(expect_rim_at_radius); }

INSTANTIATE_TEST_SUITE_P(All, RegionMeshes, testing::ValuesIn(families()), family_name);

class RealRegionMeshes : public testing::TestWithParam<const char*> {};

TEST_P(RealRegionMeshes, HaveTheFacesOfTheirVerticesAndTheirRim) {
  MESHHOOD_NEED_SHARED_MESHES();
  std::size_t regions = 0;
  const std::size_t meshes = for_each_shared_mesh(GetParam(), [&](const TestMesh& mesh) {
    const RegionOracle oracle(mesh);
    const double mean_edge = oracle.graph().mean_edge();
    RegionMesher mesher(mesh.view());
    Random random(5);
    for (std::size_t i = 0; i < scaled(20, 2) && !HasFailure(); ++i, ++regions) {
      PlainStart start;
      start.seeds = {static_cast<VertexId>(random.below(mesh.size()))};
      start.center = position(mesh, start.seeds[0]);
      for (double& x : start.center) x += 0.4 * mean_edge * random.uniform(-1, 1);
      start.walls = draw_mask(random, mesh.size(), i % 2 == 0 ? 0 : 12);
      start.ignored.assign(mesh.size(), 0);
      const double radius = mean_edge * random.uniform(0, 12);
      const FoundRegion region{mesh, mesher, start, radius, oracle.region(start, radius)};
      expect_faces_of_vertices(region);
      expect_rim_of_segments(region);
      expect_rim_at_radius(region);
    }
  });
  std::printf("%s: %zu meshes, %zu regions\n", GetParam(), meshes, regions);
  EXPECT_GT(meshes, 0U);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealRegionMeshes, shared_folders(), shared_folder_case);

TEST(Rim, OfABallOnAGridIsOneLoopWithTheRegionOnItsLeft) {
  const TestMesh mesh = make_grid(11, 11, false);
  const RegionOracle oracle(mesh);
  const PlainStart start{{5, 5, 0}, {60}, std::vector<std::uint8_t>(121), std::vector<std::uint8_t>(121)};
  RegionMesher mesher(mesh.view());
  const Rim rim = mesher.rim(oracle.region(start, 3.3), start.center, 3.3);
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
  RegionMesher mesher(mesh.view());
  const Rim rim = mesher.rim(std::array<VertexId, 3>{0, 1, 6}, {0, 0, 0}, 1.0);
  ASSERT_THAT(rim.closed, ElementsAre(0));
  EXPECT_EQ(rim.edges.front()[0] + rim.edges.back()[0], 7U);
}

TEST(Rim, SplitsAtANonManifoldEdge) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(2, 0, 0);
  for (const double y : {1.0, -1.0, 0.5}) mesh.add_face({0, 1, mesh.add_vertex(0.1, y, y * y)});
  mesh.finish(false);
  RegionMesher mesher(mesh.view());
  const Rim rim = mesher.rim(std::array<VertexId, 1>{0}, {0, 0, 0}, 0.25);
  EXPECT_THAT(rim.closed, ElementsAre(0, 0, 0));
  EXPECT_EQ(rim.points.size(), 6U);
}

TEST(Rim, OfTheWholeMeshIsEmpty) {
  const TestMesh mesh = make_grid(3, 3, true);
  RegionMesher mesher(mesh.view());
  const std::vector<VertexId> all{0, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_THAT(mesher.rim(all, {0, 0, 0}, kInfinity).points, IsEmpty());
}

TEST(ExitPoint, IsExactForExactNumbers) {
  const Point p = exit_point({1, 0, 0}, {5, 0, 0}, {0, 0, 0}, 3);
  EXPECT_EQ(p.x, 3);
  EXPECT_EQ(exit_point({3, 0, 0}, {5, 0, 0}, {0, 0, 0}, 3).x, 3) << "the inner end lies at the radius";
  EXPECT_EQ(exit_point({1, 0, 0}, {2, 0, 0}, {0, 0, 0}, 3).x, 2) << "the outer end lies inside";
  EXPECT_EQ(exit_point({0x1p499, 0, 0}, {0x1p500, 0, 0}, {0, 0, 0}, 0x1.8p499).x, 0x1.8p499);
  EXPECT_EQ(exit_point({0x1p-900, 0, 0}, {0x1p-800, 0, 0}, {0, 0, 0}, 0).x, 0x1p-800) << "squares underflow";
}

TEST(RegionMesher, RefusesInvalidArguments) {
  const TestMesh mesh = make_grid(3, 3, true);
  RegionMesher mesher(mesh.view());
  const std::array<VertexId, 2> wrong{0, 9};
  expect_refused(ErrorCode::VertexOutOfRange, "ids: position 1: vertex 9",
                 [&] { static_cast<void>(mesher.faces(wrong)); });
  const std::array<VertexId, 1> far{8};
  expect_refused(ErrorCode::InvalidOption, "vertex 8 is not within the radius 1",
                 [&] { static_cast<void>(mesher.rim(far, {0, 0, 0}, 1)); });
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { static_cast<void>(mesher.rim(far, {0, 0, 0}, -1)); });
  expect_refused(ErrorCode::InvalidOption, "center: coordinate 0 is inf",
                 [&] { static_cast<void>(mesher.rim(far, {kInfinity, 0, 0}, 1)); });
  const std::vector<float> positions{0, 0, 0};
  const std::vector<std::uint32_t> corners{0, 0, 1};
  expect_refused(ErrorCode::InvalidMesh, "face 0", [&] { RegionMesher({positions, FacesView::triangles(corners)}); });
}

}  // namespace
}  // namespace meshhood::test
