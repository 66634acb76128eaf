// SPDX-License-Identifier: MIT
// The first hit of a ray, against a scan of all triangles in long double that solves for the hit by determinants.
#include "surface/first_hit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/search.h"
#include "meshhood/surface.h"

#include "base/validate.h"
#include "base/vector.h"
#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/long_point.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/round_meshes.h"
#include "support/scale.h"
#include "support/test_triangles.h"

namespace meshhood::test {
namespace {

SpacePoint space(const Point& p) { return {p.x, p.y, p.z}; }

Long determinant(const LongPoint& a, const LongPoint& b, const LongPoint& c) { return dot_of(a, cross_of(b, c)); }

/// A hit by Cramer's rule. `margin` is the least weight: near 0 the ray passes close to a side.
struct LongHit {
  Long distance;
  Long margin;
  Long slope;  // one over the sine between ray and triangle
};

LongHit hit_of(const Point& origin, const Point& direction, const std::array<Point, 3>& corners) {
  const LongPoint a = minus(corners[0], origin);
  const LongPoint b = minus(corners[1], origin);
  const LongPoint c = minus(corners[2], origin);
  const LongPoint d = minus(direction, {0, 0, 0});
  const std::array weights{determinant(d, b, c), determinant(a, d, c), determinant(a, b, d)};
  const Long sum = weights[0] + weights[1] + weights[2];
  const Long length = std::sqrt(dot_of(d, d));
  const LongPoint normal = cross_of(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const Long area = std::sqrt(dot_of(normal, normal));
  return {determinant(a, b, c) / sum * length, std::min({weights[0] / sum, weights[1] / sum, weights[2] / sum}),
          area * length / std::abs(sum)};
}

/// The first hit in double of a scan, by the rule for one triangle.
TriangleHit scan(const Ray& ray, const TestMesh& mesh, const TestTriangles& triangles) {
  TriangleHit first;
  for (std::size_t t = 0; t < triangles.faces.size(); ++t) {
    const auto& [a, b, c] = triangles.corners[t];
    const auto at = ray.meet({corner_of(mesh, a), corner_of(mesh, b), corner_of(mesh, c)});
    if (at && at->distance < first.at.distance) first = {t, *at};
  }
  return first;
}

/// Rays in all ways that are special: to a corner, to a side, along an axis, from a vertex, from far away.
struct DrawnRay {
  Point origin;
  Point direction;
};

DrawnRay draw_ray(Random& random, const TestMesh& mesh) {
  const auto vertex = [&] { return corner_of(mesh, static_cast<std::uint32_t>(random.below(mesh.size()))); };
  const auto anywhere = [&] {
    const SpacePoint p = draw_start(random, mesh).plain.center;
    return Point{p[0], p[1], p[2]};
  };
  const auto unit = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  const Point origin = random.below(4) == 0 ? vertex() : anywhere();
  const auto towards = [&](const Point& p) { return DrawnRay{origin, p - origin}; };
  switch (random.below(6)) {
    case 0: return towards(vertex());
    case 1: return towards(0.5 * vertex() + 0.5 * vertex());
    case 2: {
      std::array<double, 3> along{0, 0, 0};
      along[random.below(3)] = random.below(2) == 0 ? 1 : -1;
      return {origin, {along[0], along[1], along[2]}};
    }
    case 3: {
      const DrawnRay ray = towards(anywhere());
      return {origin - 1e6 * ray.direction, ray.direction};
    }
    case 4: return {origin, std::ldexp(1.0, static_cast<int>(random.below(600)) - 300) * unit()};
    default: return towards(anywhere());
  }
}

bool is_direction(const Point& d) { return squared_distance(d, {0, 0, 0}) > 0; }

MESHHOOD_SUITE_OF_FAMILIES(FirstHitIn);

TEST_P(FirstHitIn, IsTheFirstOfAScan) {
  std::size_t rays = 0;
  std::size_t hits = 0;
  for (const std::size_t vertices : {1U, 2U, 40U, 300U, 2000U}) {
    const auto [mesh, index] = indexed(make_mesh(GetParam(), vertices, vertices));
    TestMesh in_frame = mesh;  // in which squares of lengths are not 0, so that polygons are divided as they are
    for (double& x : in_frame.positions) x *= IndexAccess::view(index).frame.scale;
    const TestTriangles triangles(in_frame);
    const Surface surface(index, mesh.view().faces);
    if (triangles.faces.empty()) {
      expect_refused(ErrorCode::InvalidMesh, "no face of three corners",
                     [&] { return surface.first_hit({0, 0, 0}, {1, 0, 0}); });
      continue;
    }
    SCOPED_TRACE(mesh.name);
    Random random(vertices);
    for (std::size_t i = 0; i < scaled(100, 20); ++i) {
      const auto [origin, direction] = draw_ray(random, mesh);
      if (!is_direction(direction) || !is_valid_position(origin)) continue;
      ++rays;
      const Ray ray(origin, direction, IndexAccess::view(index).frame);
      const TriangleHit expected = scan(ray, mesh, triangles);
      const SurfacePoint found = surface.first_hit(space(origin), space(direction));
      ASSERT_EQ(found.distance, expected.at.distance) << i;
      if (found.face == kNoFace) continue;
      ++hits;
      ASSERT_EQ(found.face, triangles.faces[expected.triangle]) << i;
      ASSERT_EQ(found.vertices, triangles.corners[expected.triangle]) << i;
      ASSERT_EQ(found.point, space(expected.at.point)) << i;
      ASSERT_EQ(found.barycentric, expected.at.barycentric) << i;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(mesh.face(found.face)[found.corners[k]], found.vertices[k]);
      ASSERT_NEAR(found.barycentric[0] + found.barycentric[1] + found.barycentric[2], 1, 1e-15);
      ASSERT_GE(std::min({found.barycentric[0], found.barycentric[1], found.barycentric[2]}), 0);
    }
  }
  std::printf("%s: %zu rays, %zu hits\n", std::string(GetParam().name).c_str(), rays, hits);
}

Point random_point(Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

TEST(Ray, MeetsTrianglesWhereDeterminantsSay) {
  Random random(1);
  std::size_t hits = 0;
  std::size_t misses = 0;
  for (std::size_t i = 0; i < scaled(200000, 20000); ++i) {
    const std::array corners{random_point(random), random_point(random), random_point(random)};
    const Point origin = 2 * random_point(random);
    const Point direction = 0.4 * (corners[0] + corners[1] + corners[2]) + 0.5 * random_point(random) - origin;
    const LongHit expected = hit_of(origin, direction, corners);
    if (std::abs(expected.margin) < 1e-12L || std::abs(expected.distance) < 1e-12L) continue;
    const auto found = Ray(origin, direction, {}).meet(corners);
    ASSERT_EQ(found.has_value(), expected.margin > 0 && expected.distance > 0) << i;
    if (!found) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_NEAR(found->distance, static_cast<double>(expected.distance), 1e-14 * static_cast<double>(expected.slope));
    const Point on_ray = origin + found->distance / length(direction) * direction;
    ASSERT_NEAR(length(found->point - on_ray), 0, 2e-14 * static_cast<double>(expected.slope)) << i;
  }
  std::printf("%zu hits, %zu misses\n", hits, misses);
  EXPECT_GT(std::min(hits, misses), 1000U);
}

// By areas alone, the weights of a sliver would have as few digits as its width.
TEST(Ray, MeetsASliverToAFewUnitsOfItsLongestSide) {
  Random random(2);
  double most = 0;
  std::size_t hits = 0;
  for (const double width : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    for (std::size_t i = 0; i < scaled(10000, 1000); ++i) {
      const Point a = random_point(random);
      const Point b = random_point(random);
      const Point c = a + random.uniform() * (b - a) + width * random_point(random);
      const double share = random.uniform();
      const Point on_it = a + share * (b - a) + ((1 - share) * random.uniform()) * (c - a);
      const Point direction = cross(cross(b - a, c - a), b - a);  // along its plane, across it
      const Point normal = cross(b - a, c - a);
      const Point along = (1 / length(normal)) * normal + (0.5 / length(direction)) * direction;
      const auto found = Ray(on_it - along, along, {}).meet({a, b, c});
      if (!found) continue;
      ++hits;
      most = std::max(most, length(found->point - on_it));
    }
  }
  std::printf("%zu hits, at most %.2g units of 2^-53\n", hits, most * 0x1p53);
  EXPECT_GT(hits, 1000U);
  EXPECT_LE(most, 64 * 0x1p-53);
}

/// The corners of a cap are collinear but for rounding, so its areas as the ray sees them are rounding, too.
TEST(Ray, MeetsACapOnTheRay) {
  Random random(9);
  double most = 0;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scaled(100000, 10000); ++i) {
    const Point a = random_point(random);
    const Point b = random_point(random);
    const std::array corners{a, b, a + random.uniform() * (b - a)};
    const Point origin = 2 * random_point(random);
    const Point direction = a + random.uniform() * (b - a) - origin;
    const auto found = Ray(origin, direction, {}).meet(corners);
    if (!found) continue;
    ++hits;
    ASSERT_GE(std::ranges::min(found->barycentric), 0) << i;
    most = std::max(most, length(origin + found->distance / length(direction) * direction - found->point));
  }
  std::printf("%zu hits, at most %.2g units of 2^-53\n", hits, most * 0x1p53);
  EXPECT_GT(hits, 1000U);
  EXPECT_LE(most, 64 * 0x1p-53);
}

/// Rays to a point of a cap. The second leaves a closed body, in which no other triangle is ahead.
TEST(Ray, MeetsACapAtItsDistance) {
  struct Case {
    std::array<Point, 3> corners;
    Point origin;
    Point direction;
  };
  const Case cases[] = {
      {{{{1.156684816361389, 0.2556536953260734, -0.28195093113356795},
         {-0.6687632486800595, 0.02914187841028646, -1.0272423409142437},
         {1.0251246650039123, 0.23932897511716328, -0.33566412766537207}}},
       {-2.1349531896997123, 1.1762362884771016, 0.8072949629243333},
       {1.8926297128853187, -1.0941793754622824, -1.6604310639258597}},
      {{{{0, -1.1223924735486979, 0}, {-1155.8555292024978, 0, 0}, {-20.64839823166753, -1.102341864990334, 0}}},
       {-10.50010019223354, -0.006981018155285734, 0.07274969336312598},
       {3.088129614902522, -1.1082140680210468, -0.07274969336312598}}};
  for (const auto& [corners, origin, direction] : cases) {
    const auto found = Ray(origin, direction, {}).meet(corners);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, length(direction), 1e-14);
  }
}

/// Such a triangle leads from before the origin to behind it, so its weights in double do not tell where it is met.
TEST(Ray, MeetsWhatLiesAheadIfItIsSeenNearlyFromItsSide) {
  Random random(10);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scaled(100000, 10000); ++i) {
    // Whole numbers, so that all is exact.
    const auto whole = [&](std::uint64_t bound) { return static_cast<double>(random.below(bound)); };
    const double x = 0x1p36 + whole(1ULL << 36U);
    const double y = x + 1 + whole(100);
    const Point u{x, y, whole(1ULL << 37U) - 0x1p36};
    const Point v{x + 1, y + 1, whole(1ULL << 37U) - 0x1p36};
    const std::array<double, 4> share{whole(9) - 4, whole(9) - 4, whole(9) - 4, whole(9) - 4};
    if (share[0] * share[3] == share[1] * share[2]) continue;  // a line
    const Point a = share[0] * u + share[1] * v;
    const Point b = share[2] * u + share[3] * v;
    const Point middle{0, 0, whole(1ULL << 30U)};
    const auto found = Ray({0, 0, 0}, {0, 0, 1}, {}).meet({middle + a, middle + b, middle - (a + b)});
    ASSERT_TRUE(found) << i;
    ++hits;
  }
  EXPECT_GT(hits, 1000U);
}

TEST(Ray, OnASideMeetsBothTrianglesAtTheSameDistance) {
  Random random(3);
  std::size_t at_side = 0;
  for (std::size_t i = 0; i < scaled(200000, 50000); ++i) {
    // Small integers, so that all is exact.
    const auto number = [&] { return static_cast<double>(random.below(17)) - 8; };
    const auto draw = [&] { return Point{number(), number(), number()}; };
    const std::array corners{draw(), draw(), draw()};
    const Point direction{number() / 8, number() / 8, 1};
    const Point origin = 0.5 * corners[0] + 0.5 * corners[1] - 2 * direction;
    const Ray ray(origin, direction, {});
    const auto found = ray.meet(corners);
    const auto other = ray.meet({corners[1], corners[0], draw()});
    if (!found || !other || found->barycentric[2] != 0 || other->barycentric[2] != 0) continue;
    ASSERT_EQ(found->distance, other->distance) << i;
    ASSERT_EQ(found->barycentric[0], other->barycentric[1]) << i;
    ASSERT_EQ(space(found->point), space(other->point)) << i;
    at_side += static_cast<std::size_t>(found->barycentric[0] != 0 && found->barycentric[1] != 0);
  }
  std::printf("%zu at a side\n", at_side);
  EXPECT_GT(at_side, 1000U);
}

/// From inside a closed surface there is no way out.
TEST(FirstHit, FromInsideIsNeverNoneThroughCornersAndSides) {
  const auto [mesh, index, surface] = with_surface(ball(24, 31));
  Random random(4);
  std::size_t exact = 0;
  for (std::size_t i = 0; i < scaled(200000, 20000); ++i) {
    const Point origin = (i % 3 == 0 ? 0.0 : 0.4) * random_point(random);
    const auto face = mesh.face(random.below(mesh.face_count()));
    const std::size_t k = random.below(3);
    const Point a = corner_of(mesh, face[k]);
    const Point b = corner_of(mesh, face[(k + 1) % 3]);
    const double share = i % 2 == 0 ? 0 : random.uniform();
    const SurfacePoint found = surface.first_hit(space(origin), space(a + share * (b - a) - origin));
    ASSERT_NE(found.face, kNoFace) << i;
    exact += static_cast<std::size_t>(std::ranges::count(found.barycentric, 0.0) > 0);
  }
  std::printf("%zu exactly at a side or a corner\n", exact);
  EXPECT_GT(exact, 1000U);
}

TEST(FirstHit, AlongAnAxisThroughAGridIsTheFaceWithTheSmallestNumber) {
  const auto [mesh, index, surface] = with_surface(make_grid(9, 7, false));
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const std::size_t first = first_face_of(mesh, v);
    const Point p = corner_of(mesh, v);
    for (const double side : {-1.0, 1.0}) {
      const SurfacePoint found = surface.first_hit({p.x, p.y, p.z + 3 * side}, {0, 0, -1e-200 * side});
      ASSERT_EQ(found.face, first);
      ASSERT_EQ(found.distance, 3);
      ASSERT_EQ(found.point, space(p));
      ASSERT_EQ(surface.first_hit(space(p), {0, 0, side}).distance, 0) << "from the surface itself";
    }
    ASSERT_EQ(surface.first_hit({p.x, p.y, p.z + 3}, {0, 0, 1}).face, kNoFace) << "behind";
  }
  EXPECT_EQ(surface.first_hit({-1, 2, 0}, {1, 0, 0}).face, kNoFace) << "in the plane of all faces";
}

/// A cube, seen along the plane of its top: the faces beside are hit at their sides.
TEST(FirstHit, GrazingAFaceHitsTheOnesThatItMeets) {
  TestMesh mesh;
  for (unsigned i = 0; i < 8; ++i) mesh.add_vertex(i & 1U, i >> 1U & 1U, i >> 2U);
  for (const auto& face :
       {std::vector<std::uint32_t>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.add_face(face);
  }
  const Index index = build(mesh.finish(false).view());
  const Surface surface(index, mesh.view().faces);
  EXPECT_EQ(surface.first_hit({-2, 0.25, 1}, {1, 0, 0}).face, 4U);
  EXPECT_EQ(surface.first_hit({-2, 0.25, 1}, {1, 0, 0}).distance, 2);
  EXPECT_EQ(surface.first_hit({0.5, 0.25, 1}, {1, 0, 0}).face, 5U) << "from the top itself";
  EXPECT_EQ(surface.first_hit({-2, 0.25, 1 + 0x1p-52}, {1, 0, 0}).face, kNoFace);
  EXPECT_EQ(surface.first_hit({-2, -2, 1}, {1, 1, 0}).distance, std::sqrt(8)) << "along a side, to a corner";
  EXPECT_EQ(surface.first_hit({0.5, 0.25, 0.5}, {0, 0, 2}).face, 1U) << "from inside";
  const SurfacePoint found = surface.first_hit({0.25, 0.75, 3}, {0, 0, -1});
  EXPECT_EQ(found.face, 1U);
  EXPECT_THAT(found.corners, testing::ElementsAre(0, 2, 3)) << "a polygon is its triangles";
}

TEST(FirstHit, DoesNotDependOnTheUnitOfTheMesh) {
  const TestMesh mesh = ball(12, 15);
  Random random(6);
  for (const double unit : {0x1p-300, 0x1p-20, 1.0, 0x1p40, 0x1p490}) {
    TestMesh scaled_mesh = mesh;
    for (double& coordinate : scaled_mesh.positions) coordinate *= unit;
    const Index index = build(mesh.view());
    const Index scaled_index = build(scaled_mesh.view());
    const Surface surface(index, mesh.view().faces);
    const Surface scaled_surface(scaled_index, scaled_mesh.view().faces);
    for (std::size_t i = 0; i < scaled(2000, 200); ++i) {
      const Point origin = 3 * random_point(random);
      const Point direction = random_point(random);
      const SurfacePoint found = surface.first_hit(space(origin), space(direction));
      const SurfacePoint scaled_one = scaled_surface.first_hit(space(unit * origin), space(unit * direction));
      ASSERT_EQ(found.face, scaled_one.face);
      ASSERT_EQ(found.distance * unit, scaled_one.distance);
    }
  }
}

TEST(FirstHit, FromFarAwayIsThatOfAScan) {
  const TestMesh mesh = ball(12, 15);
  const TestTriangles triangles(mesh);
  const Index index = build(mesh.view());
  const Surface surface(index, mesh.view().faces);
  Random random(7);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scaled(2000, 200); ++i) {
    const Point direction = random_point(random);
    const double far = std::ldexp(1.0, static_cast<int>(random.below(490)));
    const Point origin = 0.5 * random_point(random) - far * direction;
    const SurfacePoint found = surface.first_hit(space(origin), space(direction));
    const Ray ray(origin, direction, IndexAccess::view(index).frame);
    ASSERT_EQ(found.distance, scan(ray, mesh, triangles).at.distance) << i;
    hits += static_cast<std::size_t>(found.face != kNoFace);
    ASSERT_TRUE(far >= 0x1p40 || found.face != kNoFace) << i;
  }
  EXPECT_GT(hits, 10U);
}

/// Grids by their side. The tree of the larger one has more bytes than those in which rays are searched one by one.
class FirstHits : public testing::TestWithParam<std::size_t> {};

TEST_P(FirstHits, OnSeveralThreadsAreThoseOfEachRay) {
  const auto [mesh, index, surface] = with_surface(bumpy_grid(GetParam()));
  Random random(8);
  const double end = static_cast<double>(GetParam()) + 5;
  for (const std::size_t count : {1U, 3U, 8U, 1000U}) {
    std::vector<SpacePoint> origins(count);
    std::vector<SpacePoint> directions(count);
    for (SpacePoint& p : origins) p = {random.uniform(-5, end), random.uniform(-5, end), random.uniform(-5, 5)};
    for (SpacePoint& d : directions) d = space(random_point(random));
    const std::vector<SurfacePoint> found = surface.first_hits(origins, directions, {.threads = 3});
    std::size_t hits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const SurfacePoint expected = surface.first_hit(origins[i], directions[i]);
      ASSERT_EQ(found[i].face, expected.face);
      ASSERT_EQ(found[i].distance, expected.distance);
      hits += static_cast<std::size_t>(found[i].face != kNoFace);
    }
    EXPECT_TRUE(hits > 100U || count < 1000);
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, FirstHits, testing::Values(30, 330));

TEST(FirstHit, GivesTheStartOfARegion) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  const SurfacePoint hit = Surface(index, mesh.view().faces).first_hit({10.3, 11.4, 20}, {0.1, 0, -1});
  Searcher searcher(index);
  EXPECT_GT(searcher.count(hit.start(), 3), 10U);
}

TEST(FirstHit, RefusesWrongRaysAndAnIndexRefittedInPlace) {
  const TestMesh mesh = make_grid(3, 3, false);
  Index index = build(mesh.view());
  const Surface surface(index, mesh.view().faces);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuse = [&](const char* message, const SpacePoint& origin, const SpacePoint& direction) {
    expect_refused(ErrorCode::InvalidOption, message, [&] { return surface.first_hit(origin, direction); });
  };
  refuse("origin: coordinate 1 is nan", {0, nan, 0}, {1, 0, 0});
  refuse("direction: coordinate 2 is inf", {0, 0, 0}, {1, 0, kInfinity});
  refuse("direction: it is 0", {0, 0, 0}, {0, -0.0, 0});
  const std::vector<SpacePoint> two{{0, 0, 0}, {0, 0, 1}};
  const std::vector<SpacePoint> one{{1, 0, 0}};
  expect_refused(ErrorCode::InvalidOption, "directions: row 0: it is 0", [&] { return surface.first_hits(two, two); });
  expect_refused(ErrorCode::InvalidOption, "1 directions, expected one for each of 2 origins",
                 [&] { return surface.first_hits(two, one); });
  index.refit_in_place(mesh.positions_view());
  expect_refused(ErrorCode::InvalidOption, "refit", [&] { return surface.first_hit({0, 0, 0}, {1, 0, 0}); });
}

}  // namespace
}  // namespace meshhood::test
