// SPDX-License-Identifier: MIT
// The point of the surface nearest to a point, against a scan of all faces; that of a triangle, in long double.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"
#include "meshhood/index.h"
#include "meshhood/refit.h"
#include "meshhood/run.h"
#include "meshhood/search.h"
#include "meshhood/surface.h"

#include "base/vector.h"
#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/long_point.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/reports.h"
#include "support/scale.h"
#include "support/test_triangles.h"
#include "surface/face_triangles.h"

namespace meshhood::test {
namespace {

/// The distance by the regions of Ericson, "Real-Time Collision Detection" (2005), sec. 5.1.5, in long double.
Long distance_by_regions(const Point& q, const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  const LongPoint ab = minus(b, a);
  const LongPoint ac = minus(c, a);
  const LongPoint ap = minus(q, a);
  const auto length_at = [&](Long second, Long third) {
    LongPoint offset{};
    for (std::size_t i = 0; i < 3; ++i) offset[i] = ap[i] - second * ab[i] - third * ac[i];
    return std::sqrt(dot_of(offset, offset));
  };
  const Long d1 = dot_of(ab, ap);
  const Long d2 = dot_of(ac, ap);
  if (d1 <= 0 && d2 <= 0) return length_at(0, 0);
  const LongPoint bp = minus(q, b);
  const Long d3 = dot_of(ab, bp);
  const Long d4 = dot_of(ac, bp);
  if (d3 >= 0 && d4 <= d3) return length_at(1, 0);
  const Long vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length_at(d1 / (d1 - d3), 0);
  const LongPoint cp = minus(q, c);
  const Long d5 = dot_of(ab, cp);
  const Long d6 = dot_of(ac, cp);
  if (d6 >= 0 && d5 <= d6) return length_at(0, 1);
  const Long vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length_at(0, d2 / (d2 - d6));
  const Long va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const Long share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return length_at(1 - share, share);
  }
  return length_at(vb / (va + vb + vc), vc / (va + vb + vc));
}

MESHHOOD_SUITE_OF_FAMILIES(ClosestPointIn);

TEST_P(ClosestPointIn, FindsTheFirstOfAScan) {
  std::size_t points = 0;
  for (const std::size_t vertices : {1U, 2U, 40U, 300U, 2000U}) {
    const auto [mesh, index] = indexed(make_mesh(GetParam(), vertices, vertices));
    const double scale = IndexAccess::view(index).frame.scale;
    const TestTriangles triangles(mesh, scale);
    if (triangles.faces.empty()) {
      expect_refused(ErrorCode::InvalidMesh, "no face of three corners",
                     [&] { return Surface(index, mesh.view().faces).closest_point({0, 0, 0}); });
      continue;
    }
    SCOPED_TRACE(mesh.name);
    const Surface surface(index, mesh.view().faces);
    EXPECT_EQ(surface.face_count(), mesh.face_count());
    Random random(vertices);
    for (std::size_t i = 0; i < scaled(40, 6); ++i, ++points) {
      SpacePoint q = draw_start(random, mesh).plain.center;
      if (i % 7 == 6) q = {-q[1], q[2], 1e30};
      double expected = kInfinity;
      std::size_t nearest = 0;
      for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
        const auto& [a, b, c] = triangles.corners[t];
        const std::array corners{corner_of(mesh, a), corner_of(mesh, b), corner_of(mesh, c)};
        const double distance = nearest_in_triangle({q[0], q[1], q[2]}, corners, scale).distance;
        if (!(distance < expected)) continue;
        expected = distance;
        nearest = t;
      }
      const SurfacePoint found = surface.closest_point(q);
      ASSERT_EQ(found.face, triangles.faces[nearest]) << i;
      ASSERT_EQ(found.distance, expected) << i;
      ASSERT_EQ(found.vertices, triangles.corners[nearest]) << i;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(mesh.face(found.face)[found.corners[k]], found.vertices[k]);
      ASSERT_NEAR(found.barycentric[0] + found.barycentric[1] + found.barycentric[2], 1, 1e-15);
      ASSERT_GE(std::min({found.barycentric[0], found.barycentric[1], found.barycentric[2]}), 0);
    }
  }
  std::printf("%s: %zu points\n", std::string(GetParam().name).c_str(), points);
}

TEST(TrianglePoint, HasTheDistanceOfTheRegionsAroundIt) {
  Random random(5);
  std::array<std::size_t, 4> zeros{};  // points by the number of weights that are 0
  for (std::size_t i = 0; i < scaled(200000, 5000); ++i) {
    const auto draw = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    const std::array corners{draw(), draw(), draw()};
    const Point q = draw();
    const TrianglePoint found = nearest_in_triangle(q, corners, 1);
    const Long expected = distance_by_regions(q, corners);
    ASSERT_NEAR(found.distance, static_cast<double>(expected), 1e-14);
    Point sum{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      sum.x += found.barycentric[k] * corners[k].x;
      sum.y += found.barycentric[k] * corners[k].y;
      sum.z += found.barycentric[k] * corners[k].z;
    }
    ASSERT_NEAR(std::sqrt(squared_distance(sum, found.point)), 0, 1e-14);
    ASSERT_NEAR(std::sqrt(squared_distance(q, found.point)), found.distance, 1e-14);
    ++zeros[static_cast<std::size_t>(std::count(found.barycentric.begin(), found.barycentric.end(), 0.0))];
  }
  std::printf("inside %zu, sides %zu, corners %zu\n", zeros[0], zeros[1], zeros[2]);
  EXPECT_GT(std::min({zeros[0], zeros[1], zeros[2]}), 100U);
}

TEST(TrianglePoint, OfTrianglesWithASideInCommonHasTheSameDistanceThere) {
  Random random(6);
  std::size_t at_side = 0;
  for (std::size_t i = 0; i < scaled(50000, 2000); ++i) {
    const auto draw = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    const std::array corners{draw(), draw(), draw()};
    const Point q = draw();
    const TrianglePoint found = nearest_in_triangle(q, corners, 1);
    if (found.barycentric[2] != 0) continue;
    const TrianglePoint other = nearest_in_triangle(q, {corners[1], corners[0], draw()}, 1);
    if (other.barycentric[2] != 0) continue;
    ASSERT_EQ(found.distance, other.distance) << i;
    at_side += static_cast<std::size_t>(found.barycentric[0] != 0 && found.barycentric[1] != 0);
  }
  EXPECT_GT(at_side, 100U);
}

// The normal of a sliver has few digits, so a foot that is found by it lies far away in the triangle.
TEST(TrianglePoint, OfASliverIsOffByAFewUnitsOfItsLongestSide) {
  Random random(7);
  double most = 0;
  for (const double width : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    for (const double height : {0.0, 1e-12, 1e-8, 1e-4}) {
      for (std::size_t i = 0; i < scaled(10000, 500); ++i) {
        const auto draw = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
        const Point a = draw();
        const Point b = draw();
        const Point c = a + random.uniform() * (b - a) + width * draw();
        const double share = random.uniform();
        const Point on_it = a + share * (b - a) + ((1 - share) * random.uniform()) * (c - a);
        const Point q = on_it + height * draw();
        most = std::max(most, nearest_in_triangle(q, {a, b, c}, 1).distance - std::sqrt(squared_distance(q, on_it)));
      }
    }
  }
  std::printf("at most %.2g units of 2^-53\n", most * 0x1p53);
  EXPECT_LE(most, 16 * 0x1p-53) << "sides and coordinates are about 1";
}

TEST(TrianglePoint, WithoutAnAreaIsItsSides) {
  const TrianglePoint on_line = nearest_in_triangle({1, 2, 0}, {{{0, 0, 0}, {3, 0, 0}, {2, 0, 0}}}, 1);
  EXPECT_EQ(on_line.distance, 2);
  EXPECT_EQ(on_line.point.x, 1);
  const TrianglePoint one_point = nearest_in_triangle({1, 2, 0}, {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}, 1);
  EXPECT_EQ(one_point.distance, 2);
  EXPECT_THAT(one_point.barycentric, testing::Contains(1.0));
}

TEST(ClosestPoint, OfFacesThatMeetFindsTheOneWithTheSmallestNumber) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(20));
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const std::size_t first = first_face_of(mesh, v);
    const Point p = corner_of(mesh, v);
    const SurfacePoint found = surface.closest_point({p.x, p.y, p.z});
    ASSERT_EQ(found.face, first);
    ASSERT_EQ(found.distance, 0);
    ASSERT_EQ(found.point, (SpacePoint{p.x, p.y, p.z}));
  }
}

/// The fourth power of the distance overflows in the frame.
TEST(ClosestPoint, IsFoundFromFarAway) {
  for (const double at : {0.0, 1e111}) {
    for (const double side : {0.0, 1.0}) {
      TestMesh mesh;
      for (const double y : {0.0, side}) mesh.add_vertex(at, y, 0);
      mesh.add_vertex(at, 0, side);
      mesh.add_face({0, 1, 2});
      const WithSurface one = with_surface(mesh.finish(false));
      for (const double q : {-1e50, -1e80, -1e120, -1e150}) {
        const SurfacePoint found = one.surface.closest_point({q, 0.25, 0.25});
        EXPECT_EQ(found.distance, at - q);
        EXPECT_NEAR(found.barycentric[0] + found.barycentric[1] + found.barycentric[2], 1, 1e-15);
      }
    }
  }
}

TEST(ClosestPoint, OfAConvexPolygonIsThatOfItsFan) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(4, 0, 0);
  mesh.add_vertex(4, 4, 0);
  mesh.add_vertex(0, 4, 0);
  mesh.add_face({0, 1});
  mesh.add_face({0, 1, 2, 3});
  const Index index = build(mesh.finish(true).view());
  const SurfacePoint found = Surface(index, mesh.view().faces).closest_point({1, 3, 5});
  EXPECT_EQ(found.face, 1U);
  EXPECT_THAT(found.corners, testing::ElementsAre(0, 2, 3));
  EXPECT_THAT(found.vertices, testing::ElementsAre(0, 2, 3));
  EXPECT_THAT(found.barycentric, testing::ElementsAre(0.25, 0.25, 0.5));
  EXPECT_EQ(found.point, (SpacePoint{1, 3, 0}));
  EXPECT_EQ(found.distance, 5);
}

/// The fan of an L covers points outside of it, which ones depends on its first corner.
TEST(ClosestPoint, OfAnLDoesNotDependOnItsFirstCorner) {
  const std::vector<VertexId> changed{3};
  const std::vector<std::array<double, 2>> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (std::uint32_t first = 0; first < corners.size(); ++first) {
    TestMesh mesh;
    std::vector<std::uint32_t> face;
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      mesh.add_vertex(corners[i][0], corners[i][1], 0);
      face.push_back((first + i) % 6);
    }
    mesh.add_face(face);
    const Index index = build(mesh.finish(false).view());
    Surface surface(index, mesh.view().faces);
    EXPECT_EQ(surface.closest_point({1.625, 1.75, 0}).distance, 0.625) << first;
    // The corner of the notch moves out, which makes the face convex: its triangles are other ones.
    mesh.positions[3 * 3] = mesh.positions[3 * 3 + 1] = 1.75;
    Index moved = refit(index, mesh.positions_view());
    surface.refit_in_place(moved, changed);
    EXPECT_LT(surface.closest_point({1.625, 1.75, 0}).distance, 1e-15) << first;
    EXPECT_EQ(surface.closest_point({1.7, 1.6, 0.5}).vertices,
              Surface(moved, mesh.view().faces).closest_point({1.7, 1.6, 0.5}).vertices);
  }
}

TEST(ClosestPoint, FindsAFaceThatOverhangsItsLeaf) {
  TestMesh mesh = bumpy_grid(40);
  const auto far = mesh.add_vertex(500, 0, 0);
  const auto farther = mesh.add_vertex(500, 500, 30);
  mesh.add_face({0, far, farther});
  const Index index = build(mesh.finish(true).view());
  const Surface surface(index, mesh.view().faces);
  EXPECT_EQ(surface.closest_point({300, 150, 40}).face, mesh.face_count() - 1);
}

/// Without edges each vertex has a root of its own, beyond which its faces extend.
TEST(ClosestPoint, FindsFacesThatJoinComponents) {
  const TestMesh mesh = bumpy_grid(40);
  Random random(4);
  std::vector<std::uint32_t> corners(300);
  for (std::uint32_t& v : corners) v = static_cast<std::uint32_t>(random.below(mesh.size()));
  const Adjacency no_edges{std::vector<EdgeOffset>(mesh.size() + 1, 0), {}};
  const Index index = build(GraphView{mesh.positions_view(), no_edges.view()});
  const Surface surface(index, FacesView::triangles(corners));
  const double scale = IndexAccess::view(index).frame.scale;
  for (std::size_t i = 0; i < scaled(2000, 300); ++i) {
    const Point q{random.uniform(-5, 45), random.uniform(-5, 45), random.uniform(-5, 5)};
    double expected = kInfinity;
    for (std::size_t first = 0; first < corners.size(); first += 3) {
      const std::array triangle{corner_of(mesh, corners[first]), corner_of(mesh, corners[first + 1]),
                                corner_of(mesh, corners[first + 2])};
      expected = std::min(expected, nearest_in_triangle(q, triangle, scale).distance);
    }
    ASSERT_EQ(surface.closest_point({q.x, q.y, q.z}).distance, expected) << i;
  }
}

TEST(ClosestPoint, AnswersManyPointsOnSeveralThreadsAsOneByOne) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(30));
  Random random(3);
  std::vector<SpacePoint> points(500);
  for (SpacePoint& p : points) p = {random.uniform(-5, 35), random.uniform(-5, 35), random.uniform(-5, 5)};
  const std::vector<SurfacePoint> found = surface.closest_points(points, {.threads = 3});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfacePoint expected = surface.closest_point(points[i]);
    EXPECT_EQ(found[i].face, expected.face);
    EXPECT_EQ(found[i].point, expected.point);
  }
  const auto refuse = [](std::size_t row, const SurfacePoint&) {
    if (row == 7) raise(ErrorCode::Cancelled, "row 7");
  };
  expect_refused(ErrorCode::Cancelled, "row 7", [&] { surface.for_each_closest_point(points, refuse); });
}

/// Even the points that a thread takes at once, each of which may take long.
TEST(ClosestPoint, AndFirstHitSeeProgressBetweenPoints) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(5));
  const std::vector<SpacePoint> points(200, {1, 1, 9});
  const std::vector<SpacePoint> directions(points.size(), {0, 0, -1});
  std::size_t visits = 0;
  const auto visit = [&](std::size_t, const SurfacePoint&) {
    ++visits;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so that all take longer than progress is due
  };
  const auto expect_few_visits = [&](auto&& call) {
    visits = 0;
    Reports reports;
    const Progress progress = [&](std::size_t done, std::size_t total) {
      reports.emplace_back(done, total);
      return done == 0;
    };
    expect_refused(ErrorCode::Cancelled, "cancelled", [&] { call(meshhood::Run{.threads = 1, .progress = progress}); });
    EXPECT_LT(visits, points.size());
    EXPECT_EQ(reports.back(), std::pair(visits, points.size()));
  };
  expect_few_visits([&](const meshhood::Run& run) { surface.for_each_closest_point(points, visit, run); });
  expect_few_visits([&](const meshhood::Run& run) { surface.for_each_first_hit(points, directions, visit, run); });
}

TEST(ClosestPoint, GivesTheStartOfARegion) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const SurfacePoint hit = Surface(index, mesh.view().faces).closest_point({10.3, 11.4, 2});
  Searcher searcher(index);
  EXPECT_EQ(searcher.neighborhood(hit.start(), 3), searcher.neighborhood(Start(hit.point, hit.vertices), 3));
  EXPECT_GT(searcher.count(hit.start(), 3), 10U);
}

TEST(ClosestPoint, RefusesWrongPointsWrongFacesAndAnIndexRefittedInPlace) {
  const TestMesh mesh = make_grid(3, 3, false);
  Index index = build(mesh.view());
  const Surface surface(index, mesh.view().faces);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(ErrorCode::InvalidOption, "point: coordinate 1 is nan",
                 [&] { return surface.closest_point({0, nan, 0}); });
  const std::vector<SpacePoint> points{{0, 0, 0}, {0, 0, 1e300}};
  expect_refused(ErrorCode::InvalidOption, "points: row 1: coordinate 2 is 1e+300",
                 [&] { return surface.closest_points(points); });
  const std::vector<std::uint32_t> corners{0, 1, 9};
  expect_refused(ErrorCode::InvalidMesh, "9", [&] { return Surface(index, FacesView::triangles(corners)); });
  index.refit_in_place(mesh.positions_view());
  expect_refused(ErrorCode::InvalidOption, "refit", [&] { return surface.closest_point({0, 0, 0}); });
}

}  // namespace
}  // namespace meshhood::test
