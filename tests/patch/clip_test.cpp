// SPDX-License-Identifier: MIT
// Patches as meshes, against the closed forms of their areas, the sphere, and the sides of the surface.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/patch.h"
#include "meshhood/surface.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/test_triangles.h"

namespace meshhood::test {
namespace {

using std::numbers::pi;

using Side = std::pair<std::uint32_t, std::uint32_t>;

Point point_of(const SpacePoint& p) { return {p[0], p[1], p[2]}; }

double distance(const SpacePoint& p, const Point& q) { return length(point_of(p) - q); }

/// How many triangles have each side; but for those that have a corner twice.
template <class Triangles>
std::map<Side, int> count_sides(const Triangles& triangles) {
  std::map<Side, int> counts;
  for (const auto& t : triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) ++counts[std::minmax({t[i], t[(i + 1) % 3]})];
  }
  return counts;
}

double area_of(const ClippedMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point p = point_of(mesh.points[a]);
    sum += length(cross(point_of(mesh.points[b]) - p, point_of(mesh.points[c]) - p)) / 2;
  }
  return sum;
}

/// The chords between points of the sphere that one triangle has, and other sides that one has.
struct Border {
  double length = 0;
  std::vector<Side> others;
};

Border border_of(const ClippedMesh& mesh, const Point& center, double radius) {
  Border border;
  const auto is_on_sphere = [&](std::uint32_t p) {
    const double rounding = 1e-12 * (length(point_of(mesh.points[p])) + radius);
    return distance(mesh.points[p], center) >= radius - rounding;
  };
  for (const auto& [side, count] : count_sides(mesh.triangles)) {
    if (count != 1) continue;
    if (is_on_sphere(side.first) && is_on_sphere(side.second)) {
      border.length += distance(mesh.points[side.first], point_of(mesh.points[side.second]));
    } else {
      border.others.push_back(side);
    }
  }
  return border;
}

/// V - E + F
std::ptrdiff_t characteristic(const ClippedMesh& mesh) {
  return static_cast<std::ptrdiff_t>(mesh.points.size()) -
         static_cast<std::ptrdiff_t>(count_sides(mesh.triangles).size()) +
         static_cast<std::ptrdiff_t>(mesh.triangles.size());
}

/// A mesh, and all that holds for each of its patches.
struct Whole {
  explicit Whole(const TestMesh& given)
      : mesh(given),
        triangles(mesh),
        index(build(mesh.view())),
        surface(index, mesh.view().faces),
        searcher(surface),
        sides(count_sides(triangles.corners)) {}

  ClippedMesh clip(const PatchStart& start, const Point& center, double radius, double tolerance) {
    ClippedMesh part = searcher.clip(start, radius, tolerance);
    EXPECT_EQ(part.area, searcher.measure(start, radius).area);
    EXPECT_TRUE(std::ranges::is_sorted(part.faces));
    EXPECT_EQ(part.faces.size(), part.triangles.size());
    const std::vector<std::size_t> faces = searcher.patch(start, radius);
    EXPECT_TRUE(std::ranges::includes(faces, std::set(part.faces.begin(), part.faces.end())));
    expect_points(part, center, radius);
    const Border border = border_of(part, center, radius);
    for (const Side& side : border.others) {
      EXPECT_EQ(sides.at(side_of(part.vertices[side.first], part.vertices[side.second])), 1) << "a crack";
    }
    // An arc is shorter than 1.2 chords. Parts between an arc and its chord that are left out have short chords.
    const double short_chords = std::sqrt(8 * tolerance) * radius * static_cast<double>(triangles.corners.size());
    const double missing = part.area - area_of(part);
    const double rounding = 1e-12 * (part.area + pi * radius * radius);
    EXPECT_LE(missing, tolerance * radius * (1.2 * border.length + short_chords) + rounding);
    EXPECT_GE(missing, -rounding);
    return part;
  }

  ClippedMesh clip(std::uint32_t v, double radius, double tolerance) {
    return clip(v, corner_of(mesh, v), radius, tolerance);
  }

  /// Each is where its weights say. Vertices are those of the ball, others on the sphere.
  void expect_points(const ClippedMesh& part, const Point& center, double radius) const {
    const auto kind = [](const std::array<VertexId, 3>& v) {
      return v[0] == v[1] && v[1] == v[2] ? 0 : v[1] == v[2] ? 1 : 2;
    };
    EXPECT_TRUE(std::ranges::is_sorted(part.vertices, {}, kind));
    for (std::size_t p = 0; p < part.points.size(); ++p) {
      const auto& [a, b, c] = part.vertices[p];
      const auto& [u, v, w] = part.weights[p];
      EXPECT_NEAR(u + v + w, 1, 1e-15);
      EXPECT_TRUE(u >= 0 && v >= 0 && w >= 0);
      const Point found = u * corner_of(mesh, a) + v * corner_of(mesh, b) + w * corner_of(mesh, c);
      const double largest =
          std::max({length(corner_of(mesh, a)), length(corner_of(mesh, b)), length(corner_of(mesh, c))});
      EXPECT_LE(distance(part.points[p], found), 1e-13 * (largest + radius));
      if (kind(part.vertices[p]) == 0) {
        EXPECT_EQ(distance(part.points[p], corner_of(mesh, a)), 0);
        EXPECT_LE(std::sqrt(squared_distance(point_of(part.points[p]), center)), radius);
      } else {
        EXPECT_NEAR(distance(part.points[p], center), radius, 1e-15 * (length(center) + 10 * radius));
        EXPECT_EQ(kind(part.vertices[p]) == 1, w == 0 && (b == c)) << "weights of a point on a side";
      }
    }
  }

  /// The side of the surface that has two points.
  static Side side_of(const std::array<VertexId, 3>& first, const std::array<VertexId, 3>& second) {
    std::set<VertexId> ends(first.begin(), first.end());
    ends.insert(second.begin(), second.end());
    EXPECT_EQ(ends.size(), 2) << "a side of no triangle";
    return {*ends.begin(), *ends.rbegin()};
  }

  TestMesh mesh;
  TestTriangles triangles;
  Index index;
  Surface surface;
  PatchSearcher searcher;
  std::map<Side, int> sides;
};

MESHHOOD_SUITE_OF_FAMILIES(ClippedFamilies);

TEST_P(ClippedFamilies, EndAtTheSphere) {
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < scaled(20, 2); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 150);
    if (TestTriangles(mesh).corners.empty()) continue;
    Whole whole(mesh);
    Random random(seed);
    const double edge = mean_edge_length(whole.index);
    for (std::size_t i = 0; i < 10; ++i) {
      const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
      const double radius = edge * std::exp2(random.uniform(-3, 4));
      if (!(radius > 1e-100 && radius < 1e100)) continue;
      SCOPED_TRACE("seed " + std::to_string(seed) + ", vertex " + std::to_string(v) + ", radius " +
                   std::to_string(radius));
      for (const double tolerance : {1e-1, 1e-3, 1e-6}) count += whole.clip(v, radius, tolerance).triangles.size();
      if (HasFailure()) return;
    }
  }
  std::printf("%s: %zu triangles\n", std::string(GetParam().name).c_str(), count);
}

TestMesh triangle_of(const Point& a, const Point& b, const Point& c) {
  TestMesh mesh;
  for (const Point& p : {a, b, c}) mesh.add_vertex(p.x, p.y, p.z);
  mesh.add_face({0, 1, 2});
  return mesh.finish(false);
}

TEST(Clip, OfADiscInALargeFaceIsAPolygon) {
  Whole whole(triangle_of({-50, -50, 3}, {50, -50, 3}, {0, 80, 3}));
  std::size_t before = 0;
  for (const double tolerance : {1.0, 1e-2, 1e-4, 1e-6}) {
    const ClippedMesh disc = whole.clip({0, {1, 2, 3}}, {1, 2, 3}, 2, tolerance);
    const std::size_t corners = disc.points.size();
    EXPECT_EQ(disc.triangles.size(), corners - 2);
    EXPECT_GT(corners, before);
    EXPECT_NEAR(disc.area, 4 * pi, 1e-11);
    const double turn = 2 * pi / static_cast<double>(corners);  // it is regular
    EXPECT_NEAR(area_of(disc), 4 * std::sin(turn) * static_cast<double>(corners) / 2, 1e-12);
    EXPECT_LT(1 - std::cos(turn / 2), tolerance);
    before = corners;
  }
  EXPECT_EQ(whole.clip({0, {1, 2, 3}}, {1, 2, 3}, 2, 1).points.size(), 4);
}

TEST(Clip, OfAFaceThatIsCutTwiceIsAStrip) {
  Whole whole(triangle_of({-100, 0.3, 0}, {100, -0.4, 0}, {100, 0.4, 0}));
  const ClippedMesh strip = whole.clip({0, {1, 0, 0}}, {1, 0, 0}, 2, 1e-4);
  EXPECT_THAT(strip.weights, testing::Each(testing::Each(testing::Lt(1))));
  EXPECT_EQ(std::ranges::count_if(strip.vertices, [](const auto& v) { return v[1] == v[2]; }), 4);
  EXPECT_EQ(characteristic(strip), 1);
}

/// The ends of their sides are up to 60 radii away.
TEST(Clip, OfLargeFacesEndsAtTheSphere) {
  Random random(23);
  for (std::size_t i = 0; i < 50; ++i) {
    const auto corner = [&](double x) { return Point{x, random.uniform(-1, 1), random.uniform(-1, 1)}; };
    const std::array<Point, 3> corners{corner(-59), corner(59), corner(59)};
    Whole whole(triangle_of(corners[0], corners[1], corners[2]));
    const Point center = 0.5 * corners[0] + 0.25 * corners[1] + 0.25 * corners[2];
    EXPECT_GT(whole.clip({0, {center.x, center.y, center.z}}, center, 1, 1e-3).triangles.size(), 1);
  }
}

/// A pyramid on a plate, whose top is outside of the ball: the patch is a ring.
TEST(Clip, OfASurfaceThatLeavesTheBallAndComesBackHasAHole) {
  TestMesh mesh = make_grid(21, 21, false);
  const auto vertex = [](std::uint32_t x, std::uint32_t y) { return 21 * y + x; };
  mesh.positions[3 * vertex(12, 10) + 2] = 9;
  Whole whole(mesh.finish(false));
  const ClippedMesh ring = whole.clip(vertex(9, 10), 6.1, 1e-3);
  EXPECT_EQ(characteristic(ring), 0);
  EXPECT_THAT(border_of(ring, corner_of(mesh, vertex(9, 10)), 6.1).others, testing::IsEmpty());
  EXPECT_EQ(std::ranges::count(ring.vertices, std::array<VertexId, 3>{vertex(12, 10), vertex(12, 10), vertex(12, 10)}),
            0);
}

/// Corners at exactly the radius, and sides that touch the sphere, have no two points side by side.
TEST(Clip, AtACornerOnTheSphereHasOnePoint) {
  TestMesh mesh = make_grid(15, 15, false);
  Whole whole(mesh);
  const std::uint32_t middle = 7 * 15 + 7;
  for (const double radius : {std::sqrt(0.5), 1.0, 2.0, std::sqrt(2.0), 5.0, std::sqrt(5.0), 6.0}) {
    const ClippedMesh disc = whole.clip(middle, radius, 1e-3);
    EXPECT_NEAR(disc.area, pi * radius * radius, 1e-11);
    EXPECT_EQ(characteristic(disc), 1);
    for (std::size_t p = 0; p < disc.points.size(); ++p) {
      for (std::size_t q = 0; q < p; ++q) {
        EXPECT_GT(distance(disc.points[p], point_of(disc.points[q])), 1e-6) << p << " and " << q << " of " << radius;
      }
    }
  }
}

TEST(Clip, HasTheBorderOfTheSurfaceAndOneComponent) {
  TestMesh mesh = make_grid(9, 9, false);
  const TestMesh other = mesh;
  for (std::size_t v = 0; v < other.size(); ++v) {
    mesh.add_vertex(other.positions[3 * v], other.positions[3 * v + 1], 0.5);
  }
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    mesh.add_face({other.face(f)[0] + 81, other.face(f)[1] + 81, other.face(f)[2] + 81});
  }
  Whole sheets(mesh.finish(false));
  const ClippedMesh part = sheets.clip(9 * 4, 3.3, 1e-5);
  EXPECT_THAT(part.points, testing::Each(testing::ElementsAre(testing::_, testing::_, 0)));
  EXPECT_NEAR(part.area, pi * 3.3 * 3.3 / 2, 1e-11);
  EXPECT_EQ(border_of(part, corner_of(mesh, 36), 3.3).others.size(), 2 * 3 + 2);
}

TEST(Clip, OfABallOfAnySize) {
  Whole box(make_mesh(surface_families()[0], 3, 60));
  const ClippedMesh all = box.searcher.clip(0, kInfinity);
  EXPECT_EQ(all.area, box.searcher.measure(0, kInfinity).area);
  EXPECT_THAT(all.weights, testing::Each(testing::ElementsAre(1, 0, 0)));
  for (const double radius : {0.0, 1e-310}) {
    const ClippedMesh none = box.searcher.clip(0, radius);
    EXPECT_TRUE(none.points.empty());
    EXPECT_TRUE(none.triangles.empty());
  }
}

TEST(Clip, DoesNotHaveFacesWithAWall) {
  const TestMesh mesh = make_grid(9, 9, false);
  std::vector<std::uint8_t> walls(81, 0);
  walls[4 * 9 + 5] = 1;
  const Index masks = masked(build(mesh.view()), {.walls = walls});
  const Surface surface(masks, mesh.view().faces);
  PatchSearcher searcher(surface);
  const ClippedMesh part = searcher.clip(4 * 9 + 4, 2.2);
  EXPECT_EQ(std::ranges::count_if(part.faces, [&](std::size_t f) { return std::ranges::count(mesh.face(f), 41U) > 0; }),
            0);
  EXPECT_EQ(part.area, searcher.measure(4 * 9 + 4, 2.2).area);
  EXPECT_NEAR(area_of(part), part.area, 1e-3 * 2.2 * 20);
  EXPECT_TRUE(searcher.clip(41, 2.2).points.empty()) << "the wall";
}

/// All of a polygon is divided as the surface divides it.
TEST(Clip, OfAPolygonThatIsNotConvexIsItsOwn) {
  TestMesh mesh;
  for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) mesh.add_vertex(x, y, 0);
  mesh.add_face({0, 1, 2, 3, 4, 5});
  Whole shape(mesh.finish(true));
  EXPECT_NEAR(area_of(shape.clip(0, 10, 1e-3)), 3, 1e-14);
  EXPECT_NEAR(shape.clip({0, {0.5, 0.5, 0}}, {0.5, 0.5, 0}, 0.5, 1e-6).area, pi / 4, 1e-14);
  const ClippedMesh corner = shape.clip(3, 0.75, 1e-6);
  EXPECT_NEAR(area_of(corner), 3 * pi / 4 * 0.75 * 0.75, 1e-5);
  EXPECT_EQ(characteristic(corner), 1);
}

/// The plane of a triangle touches the ball at its corner: an arc of a circle that is a point.
TEST(Clip, WhereAPlaneTouchesTheBallIsAPoint) {
  TestMesh mesh;
  for (const auto& [x, y, z] :
       std::array<std::array<int, 3>, 5>{{{6, 4, 0}, {7, 3, 1}, {8, 3, 0}, {8, 4, 1}, {6, 3, 0}}}) {
    mesh.add_vertex(x, y, z);
  }
  mesh.add_face({0, 1, 4});
  mesh.add_face({1, 2, 3});
  Whole shape(mesh.finish(true));
  const ClippedMesh part = shape.clip(0, std::sqrt(3.0), 1e-2);
  EXPECT_EQ(part.faces.back(), 1) << "the touching one";
  EXPECT_LT(part.faces.size(), 5);
}

/// Needles, and a triangle without an area between others.
TEST(Clip, OfSliversHasNoCrack) {
  Random random(17);
  for (std::size_t i = 0; i < scaled(200, 20); ++i) {
    TestMesh mesh;
    const double thin = std::exp2(random.uniform(-60, 0));
    mesh.add_vertex(0, 0, 0);
    mesh.add_vertex(10, 0, 0);
    mesh.add_vertex(random.uniform(0, 10), i % 4 == 0 ? 0 : thin, 0);
    mesh.add_vertex(5, 7, 1);
    mesh.add_vertex(5, -7, 1);
    mesh.add_face({0, 1, 2});
    mesh.add_face({1, 0, 4});
    mesh.add_face({0, 2, 3});
    mesh.add_face({2, 1, 3});
    Whole whole(mesh.finish(false));
    SCOPED_TRACE(i);
    const ClippedMesh part = whole.clip(i % 2 == 0 ? 0 : 2, random.uniform(0.1, 9), 1e-4);
    EXPECT_EQ(characteristic(part), 1);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Clip, DependsOnItsStartAndRadiusAlone) {
  const TestMesh mesh = make_mesh(surface_families()[0], 5, 300);
  Whole one(mesh);
  Whole other(mesh);
  const double edge = mean_edge_length(one.index);
  for (const std::uint32_t v : {20U, 3U, 20U}) {
    const ClippedMesh a = one.searcher.clip(v, 2.5 * edge);
    static_cast<void>(other.searcher.clip(v + 1, 5 * edge));
    const ClippedMesh b = other.searcher.clip(v, 2.5 * edge);
    EXPECT_FALSE(a.triangles.empty());
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.weights, b.weights);
  }
}

TEST(Clip, RefusesWhatIsWrong) {
  Whole whole(make_grid(3, 3, true));
  for (const double tolerance : {0.0, 1.5, -1.0, std::nan("")}) {
    expect_refused(ErrorCode::InvalidOption, "tolerance", [&] { return whole.searcher.clip(0, 1, tolerance); });
  }
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 9", [&] { return whole.searcher.clip(9, 1); });
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { return whole.searcher.clip(0, -1); });
  expect_refused(ErrorCode::InvalidOption, "face 4", [&] { return whole.searcher.clip({4, {0, 0, 0}}, 1); });
}

}  // namespace
}  // namespace meshhood::test
