// SPDX-License-Identifier: MIT
// The thickness of walls: of shapes for which it is known, and against a scan of all faces in long double.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/refit.h"
#include "meshhood/surface.h"

#include "support/indexed.h"
#include "support/long_point.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/round_meshes.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using LongTriangle = std::array<LongPoint, 3>;

LongPoint area_of(const LongTriangle& t) { return cross_of(t[1] - t[0], t[2] - t[0]); }

/// 0 of a vector of length 0.
LongPoint unit_of(const LongPoint& v) {
  const Long size = std::sqrt(dot_of(v, v));
  return (size > 0 ? 1 / size : 0) * v;
}

Long distance_of(const LongPoint& q, const LongTriangle& t) {
  const LongPoint area = area_of(t);
  const Long size = std::sqrt(dot_of(area, area));
  Long least = std::numeric_limits<Long>::infinity();
  bool has_foot = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const LongPoint side = t[(i + 1) % 3] - t[i];
    const Long share = std::clamp(dot_of(q - t[i], side) / dot_of(side, side), Long{0}, Long{1});
    const LongPoint offset = t[i] + share * side - q;
    least = std::min(least, std::sqrt(dot_of(offset, offset)));
    has_foot = has_foot && dot_of(area, cross_of(side, q - t[i])) > 0;
  }
  return has_foot ? std::abs(dot_of(area, q - t[0])) / size : least;
}

/// The way along a ray to a triangle by Cramer's rule; infinite if it does not meet it.
Long way_to(const LongPoint& p, const LongPoint& d, const LongTriangle& t) {
  const LongPoint a = t[0] - p;
  const LongPoint b = t[1] - p;
  const LongPoint c = t[2] - p;
  const std::array weights{dot_of(d, cross_of(b, c)), dot_of(d, cross_of(c, a)), dot_of(d, cross_of(a, b))};
  const Long sum = weights[0] + weights[1] + weights[2];
  const bool is_inside = std::ranges::all_of(weights, [&](Long w) { return w / sum >= -1e-15L; });
  const Long way = dot_of(a, cross_of(b, c)) / sum;
  return is_inside && way > 0 ? way : std::numeric_limits<Long>::infinity();
}

/// All triangles of a mesh, and what is opposite to a vertex or to a point of a face by a scan of them.
class Scan {
 public:
  explicit Scan(const TestMesh& mesh) : mesh_(&mesh), normals_(mesh.size()) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      triangles_.push_back({at(mesh.face(f)[0]), at(mesh.face(f)[1]), at(mesh.face(f)[2])});
      for (const std::uint32_t v : mesh.face(f)) normals_[v] = normals_[v] + area_of(triangles_.back());
    }
    for (LongPoint& n : normals_) n = unit_of(n);
  }

  struct Spot {
    LongPoint at;
    LongPoint normal;
    std::function<bool(std::size_t)> has_face;  // which then does not count
  };

  [[nodiscard]] Spot vertex(std::uint32_t v) const {
    return {at(v), normals_[v], [this, v](std::size_t f) { return std::ranges::count(mesh_->face(f), v) != 0; }};
  }

  [[nodiscard]] Spot point(std::size_t face, const SpacePoint& p) const {
    const LongPoint area = area_of(triangles_[face]);
    return {
        {p[0], p[1], p[2]}, (1 / std::sqrt(dot_of(area, area))) * area, [face](std::size_t f) { return f == face; }};
  }

  [[nodiscard]] double by_ray(const Spot& spot) const {
    Long least = std::numeric_limits<Long>::infinity();
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      if (!spot.has_face(f)) least = std::min(least, way_to(spot.at, Long{-1} * spot.normal, triangles_[f]));
    }
    return static_cast<double>(least);
  }

  /// The least over all faces of the largest ball that each allows, by bisection.
  [[nodiscard]] double by_sphere(const Spot& spot) const {
    Long least = 8;
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const auto allows = [&](Long radius) {
        return distance_of(spot.at - radius * spot.normal, triangles_[f]) >= radius;
      };
      const LongPoint area = area_of(triangles_[f]);
      const bool is_opposite = dot_of(area, spot.normal) < 0.6L * std::sqrt(dot_of(area, area));
      if (spot.has_face(f) || !is_opposite || allows(least)) continue;
      Long low = 0;
      for (int step = 0; step < 70; ++step) (allows((low + least) / 2) ? low : least) = (low + least) / 2;
    }
    return static_cast<double>(2 * least);
  }

 private:
  [[nodiscard]] LongPoint at(std::uint32_t v) const {
    return {mesh_->positions[3 * v], mesh_->positions[3 * v + 1], mesh_->positions[3 * v + 2]};
  }

  const TestMesh* mesh_;
  std::vector<LongPoint> normals_;
  std::vector<LongTriangle> triangles_;
};

std::vector<double> measure(const TestMesh& mesh, ThicknessMethod method, const BatchVertices& vertices = {}) {
  const Index index = build(mesh.view());
  return thickness(Surface(index, mesh.view().faces), vertices, method);
}

/// A sheet of n by n squares, each cut in two, from `corner` along `u` and `v`, with its inner vertices moved. The
/// normal is the cross product of `u` and `v`. Returns its first vertex.
std::uint32_t add_sheet(TestMesh& mesh, Random& random, const LongPoint& corner, const LongPoint& u, const LongPoint& v,
                        std::uint32_t n) {
  const auto first = static_cast<std::uint32_t>(mesh.size());
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const auto share = [&](std::uint32_t k) {
        return (static_cast<double>(k) + (k > 0 && k < n ? random.uniform(-0.4, 0.4) : 0)) / static_cast<double>(n);
      };
      const LongPoint p = corner + Long{share(i)} * u + Long{share(j)} * v;
      mesh.add_vertex(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t at = first + i * (n + 1) + j;
      mesh.add_face({at, at + n + 1, at + 1});
      mesh.add_face({at + 1, at + n + 1, at + n + 2});
    }
  }
  return first;
}

TEST(Thickness, OfAPlateIsThatOfThePlateWhateverItsTriangles) {
  constexpr double kThick = 0.3;
  Random random(1);
  TestMesh mesh;
  add_sheet(mesh, random, {-2, -2, kThick}, {4, 0, 0}, {0, 4, 0}, 17);
  add_sheet(mesh, random, {-2, -2, 0}, {0, 4, 0}, {4, 0, 0}, 5);
  mesh.finish(false);
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    const std::vector<double> found = measure(mesh, method);
    std::size_t inner_ones = 0;
    for (std::size_t v = 0; v < mesh.size(); ++v) {
      if (std::max(std::abs(mesh.positions[3 * v]), std::abs(mesh.positions[3 * v + 1])) > 1.9) continue;
      ASSERT_NEAR(found[v], kThick, 2e-16) << v;
      ++inner_ones;
    }
    EXPECT_GT(inner_ones, 200U);
  }
}

TEST(Thickness, OfAWedgeFollowsFromItsAngle) {
  for (const double degrees : {3.0, 30.0, 60.0, 90.0, 110.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    Random random(2);
    TestMesh mesh;
    add_sheet(mesh, random, {0, -4, 0}, {0, 8, 0}, {1, 0, 0}, 9);  // seen from below
    const std::size_t lower = mesh.size();
    const LongPoint up{std::cos(angle), 0, std::sin(angle)};
    add_sheet(mesh, random, {0, -4, 0}, Long{20} * up, {0, 8, 0}, 6);
    mesh.finish(false);
    const std::vector<double> by_ray = measure(mesh, ThicknessMethod::Ray);
    const std::vector<double> by_sphere = measure(mesh, ThicknessMethod::Sphere);
    for (std::size_t v = 0; v < lower; ++v) {
      const double x = mesh.positions[3 * v];
      if (x == 0 || std::abs(mesh.positions[3 * v + 1]) > 3.5) continue;
      ASSERT_TRUE(degrees > 80 || std::abs(by_ray[v] - x * std::tan(angle)) < 1e-14) << v;
      ASSERT_NEAR(by_sphere[v], 2 * x * std::tan(angle / 2), 1e-14) << v << " at " << degrees;
    }
  }
}

/// The faces lie inside of the sphere by the height h of their arcs, and normals of vertices are off by an angle e. At
/// the angle t from the vertex, a face then makes the largest ball smaller by (h + e sin t) / (1 - cos t): up to
/// 2.5 h + 2 e of its radius where faces begin to be opposite.
TEST(Thickness, OfABallIsItsDiameterUpToItsFaces) {
  const TestMesh mesh = ball(48, 63);
  std::vector<VertexId> some;
  const std::size_t step = mesh.size() / scaled(mesh.size(), 100);
  for (std::size_t v = 0; v < mesh.size(); v += step) some.push_back(static_cast<VertexId>(v));
  for (const auto& [method, lowest] : {std::pair(ThicknessMethod::Ray, 1.998), {ThicknessMethod::Sphere, 1.94}}) {
    const std::vector<double> found = measure(mesh, method, some);
    const auto [least, most] = std::ranges::minmax(found);
    std::printf("%g to %g\n", least, most);
    EXPECT_GT(least, lowest);
    EXPECT_LT(most, 2 + 1e-12);
  }
}

TEST(Thickness, OfAPinIsItsDiameterUpToItsFaces) {
  constexpr std::uint32_t kSides = 60;
  TestMesh mesh;
  for (std::uint32_t ring = 0; ring <= 20; ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double around = 2 * std::numbers::pi * i / kSides;
      mesh.add_vertex(std::cos(around), std::sin(around), 0.3 * ring);
    }
  }
  for (std::uint32_t ring = 0; ring < 20; ++ring) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t at = ring * kSides + i;
      const std::uint32_t next = ring * kSides + (i + 1) % kSides;
      mesh.add_face({at, next, next + kSides, at + kSides});
    }
  }
  mesh.finish(false);
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    const std::vector<double> found = measure(mesh, method);
    for (std::size_t v = 5 * kSides; v < 15 * kSides; ++v) ASSERT_NEAR(found[v], 2, 0.01) << v;
  }
}

TEST(Thickness, IsThatOfAScanOfAllFacesAlsoWhereOthersAreFarAway) {
  for (const double far : {0.0, 1e10, 1e15, 1e30}) {
    Random random(3);
    TestMesh mesh = ball(14, 17);
    for (double& x : mesh.positions) x *= 1 + 0.04 * random.uniform(-1, 1);
    mesh.add_face({3, 100, 200});  // not manifold
    const std::size_t near = mesh.size();
    mesh.add_vertex(-far, far, far);  // in no face
    if (far > 0)
      mesh.add_face({mesh.add_vertex(far, 0, 0), mesh.add_vertex(far, far, 0), mesh.add_vertex(far, 0, far)});
    mesh.finish(false);
    const Scan scan(mesh);
    const std::vector<double> by_ray = measure(mesh, ThicknessMethod::Ray);
    const std::vector<double> by_sphere = measure(mesh, ThicknessMethod::Sphere);
    for (std::uint32_t v = 0; v < near; ++v) {
      const double ray = scan.by_ray(scan.vertex(v));
      ASSERT_TRUE(by_ray[v] == ray || std::abs(by_ray[v] - ray) < 1e-13) << v << ": " << by_ray[v] << ", " << ray;
      ASSERT_NEAR(by_sphere[v], scan.by_sphere(scan.vertex(v)), 1e-12) << v << ", " << far;
    }
  }
}

/// A point of a triangle with these weights of the corners.
SpacePoint point_of(const TestMesh& mesh, std::size_t face, const std::array<double, 3>& weights) {
  SpacePoint p{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t i = 0; i < 3; ++i) p[i] += weights[corner] * mesh.positions[3 * mesh.face(face)[corner] + i];
  }
  return p;
}

TEST(Thickness, OfPointsIsThatOfAScanOfAllFaces) {
  Random random(5);
  TestMesh mesh = ball(14, 17);
  for (double& x : mesh.positions) x *= 1 + 0.04 * random.uniform(-1, 1);
  mesh.add_vertex(1e15, 0, 0);  // in no face
  mesh.finish(false);
  const Surface surface = with_surface(mesh).surface;
  const Scan scan(mesh);
  std::vector<std::size_t> faces;
  std::vector<SpacePoint> points;
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    const double a = random.uniform(0.1, 0.6);
    const double b = random.uniform(0.1, 0.3);
    faces.push_back(face);
    points.push_back(point_of(mesh, face, {a, b, 1 - a - b}));
  }
  const std::vector<double> by_ray = thickness(surface, faces, points);
  const std::vector<double> by_sphere = thickness(surface, faces, points, ThicknessMethod::Sphere, {.threads = 3});
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Scan::Spot spot = scan.point(faces[i], points[i]);
    ASSERT_NEAR(by_ray[i], scan.by_ray(spot), 1e-12) << i;
    ASSERT_NEAR(by_sphere[i], scan.by_sphere(spot), 1e-12) << i;
  }
}

TEST(Thickness, OfPointsOfAPlateIsThatOfThePlateAtCornersAndSidesToo) {
  constexpr double kThick = 0.3;
  Random random(6);
  TestMesh mesh;
  add_sheet(mesh, random, {-2, -2, kThick}, {4, 0, 0}, {0, 4, 0}, 17);
  const std::size_t upper = mesh.face_count();
  add_sheet(mesh, random, {-2, -2, 0}, {0, 4, 0}, {4, 0, 0}, 5);
  const auto needle = mesh.add_vertex(0, 0, 9);
  mesh.add_face({needle, needle, 0});
  mesh.finish(false);
  const Surface surface = with_surface(mesh).surface;
  const Scan scan(mesh);
  std::vector<std::size_t> faces;
  std::vector<SpacePoint> points;
  for (std::size_t face = 0; face < upper; ++face) {
    for (const auto& weights : {std::array{1.0, 0.0, 0.0}, {0.3, 0.7, 0.0}, {0.0, 0.1, 0.9}, {0.2, 0.3, 0.5}}) {
      const SpacePoint p = point_of(mesh, face, weights);
      const bool is_turned = scan.point(face, p).normal[2] < 0;  // by the moves of vertices
      if (is_turned || std::max(std::abs(p[0]), std::abs(p[1])) > 1.8) continue;
      faces.push_back(face);
      points.push_back({p[0], p[1], p[2] + 0.01});  // the nearest point of the face counts
    }
  }
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    for (const double found : thickness(surface, faces, points, method)) ASSERT_NEAR(found, kThick, 2e-15);
    const std::vector<std::size_t> last{mesh.face_count() - 1};
    EXPECT_TRUE(std::isnan(thickness(surface, last, std::vector<SpacePoint>(1), method)[0])) << "without an area";
  }
}

/// An L of walls 1 thick, 10 high, turned and far from the origin. Faces that meet in its inner side touch the balls
/// there, whatever rounding makes of it.
TEST(Thickness, OfPointsAtAnInnerSideIsThatOfTheWall) {
  constexpr std::array<std::array<double, 2>, 6> kOutline{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  const auto turned = [](double x, double y, double z) {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    return SpacePoint{c * x - s * y + 100, c * (s * x + c * y) - s * z, s * (s * x + c * y) + c * z};
  };
  TestMesh mesh;
  for (const double z : {-5.0, 5.0}) {
    for (const auto& [x, y] : kOutline) {
      const SpacePoint p = turned(x, y, z);
      mesh.add_vertex(p[0], p[1], p[2]);
    }
  }
  for (std::uint32_t i = 0; i < 6; ++i) mesh.add_face({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  mesh.add_face({6, 7, 8, 9, 10, 11});
  mesh.add_face({5, 4, 3, 2, 1, 0});
  mesh.finish(false);
  const Surface surface = with_surface(mesh).surface;
  std::vector<SpacePoint> points;
  for (const double off : {0.0, 1e-15, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-3, 0.1}) {
    for (int z = -2; z <= 2; ++z) points.push_back(turned(1 + off, 1, 0.37 * z));
  }
  const std::vector<std::size_t> faces(points.size(), 2);
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    const std::vector<double> found = thickness(surface, faces, points, method);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], 1, 1e-12) << i;
  }
}

TEST(Thickness, OfSomeVerticesIsThatOfAll) {
  const TestMesh mesh = ball(9, 11);
  const Surface surface = with_surface(mesh).surface;
  const std::vector<VertexId> some{7, 3, 7, 40};
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    const std::vector<double> all = thickness(surface, {}, method);
    const std::vector<double> found = thickness(surface, some, method, {.threads = 3});
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(found[i], all[some[i]]);
  }
}

TEST(Thickness, IsInfiniteWhereNothingIsOppositeAndNanWithoutANormal) {
  TestMesh mesh;
  Random random(4);
  add_sheet(mesh, random, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3);
  const auto alone = mesh.add_vertex(0.5, 0.5, -1);
  mesh.finish(false);
  for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
    const std::vector<double> found = measure(mesh, method);
    EXPECT_EQ(found[0], kInfinity);
    EXPECT_TRUE(std::isnan(found[alone]));
  }
}

/// Two triangles whose ball is larger than the diagonal, or smaller if the second is lower. Neither the unit, nor a
/// vertex in no face, nor where that was before a refit decides whether the ball counts.
TEST(Thickness, BySphereIsInfiniteBeyondTheDiagonalOfTheFaces) {
  const auto make = [](double rise, double unit, double alone) {
    TestMesh mesh;
    for (const auto& [x, y, z] : {std::array{0.0, 0.0, 0.0},
                                  {-0.3, 0.2, 0.0},
                                  {-0.3, -0.2, 0.0},
                                  {6.0, 0.0, -rise},
                                  {6.4, 0.3, -rise},
                                  {6.4, -0.3, -rise},
                                  {alone, 0.0, 0.0}}) {
      mesh.add_vertex(unit * x, unit * y, unit * z);
    }
    mesh.add_face({0, 1, 2});
    mesh.add_face({3, 4, 5});
    return mesh.finish(false);
  };
  for (const auto& [rise, thick] : {std::pair(1.0, kInfinity), {3.05, kInfinity}, {4.0, 13.0}}) {
    for (const double unit : {1.0, 1.2, 1.7, 2.0, 1e9}) {
      for (const double alone : {0.0, 9.0, 1000.0, 1e6}) {
        const TestMesh mesh = make(rise, unit, alone);
        const Index fresh = build(mesh.view());
        const std::vector<VertexId> last{6};
        const Index moved = refit(indexed(make(rise, unit, 10)).index, mesh.positions_view(), last);
        for (const Index* index : {&fresh, &moved}) {
          const double found = thickness(Surface(*index, mesh.view().faces), {}, ThicknessMethod::Sphere)[0] / unit;
          EXPECT_TRUE(found == thick || std::abs(found - thick) < 1e-9) << found << ", " << unit << ", " << alone;
        }
      }
    }
  }
}

TEST(Thickness, RefusesWrongVerticesAndMeshesWithoutFaces) {
  const TestMesh mesh = ball(5, 6);
  const Index index = build(mesh.view());
  const std::vector<VertexId> wrong{0, 1000};
  expect_refused(ErrorCode::VertexOutOfRange,
                 "row 1: ", [&] { return thickness(Surface(index, mesh.view().faces), wrong); });
  const Surface surface(index, mesh.view().faces);
  const std::vector<std::size_t> faces{0, mesh.face_count()};
  const std::vector<SpacePoint> points{{0, 0, 1}, {0, 0, kInfinity}};
  const auto refuse = [&](const std::string& with, std::span<const std::size_t> some, std::span<const SpacePoint> at) {
    expect_refused(ErrorCode::InvalidOption, with, [&] { return thickness(surface, some, at); });
  };
  refuse("faces: row 1: face " + std::to_string(mesh.face_count()), faces, points);
  refuse("points: row 1: coordinate 2 is inf", std::vector<std::size_t>{0, 0}, points);
  refuse("2 points, expected one for each of 1 faces", std::vector<std::size_t>{0}, points);
  expect_refused(ErrorCode::InvalidMesh, "no face of three corners",
                 [&] { return thickness(Surface(index, FacesView{})); });
}

}  // namespace
}  // namespace meshhood::test
