// SPDX-License-Identifier: MIT
// Curvatures of meshes, compared with formulas, with the fit to the points themselves, and with themselves after
// changes that must have no effect.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/curvature.h"
#include "meshhood/masks.h"
#include "meshhood/refit.h"

#include "base/vector.h"
#include "curvature/quadric.h"
#include "exact/index_access.h"
#include "support/families.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/test_mesh.h"
#include "surface/surface.h"

namespace meshhood::test {
namespace {

constexpr double kPi = std::numbers::pi;
const CurvatureOptions kUnfilteredJet{.filter = false, .fit = CurvatureFit::Jet};

/// A surface over a grid of angles that is closed in both directions.
template <class F>
TestMesh closed_grid(std::size_t rows, std::size_t columns, F&& at) {
  TestMesh mesh;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const Point p = at(2 * kPi * static_cast<double>(i) / static_cast<double>(rows),
                         2 * kPi * static_cast<double>(j) / static_cast<double>(columns));
      mesh.add_vertex(p.x, p.y, p.z);
    }
  }
  add_grid_faces(mesh, {.rows = rows, .regions = columns, .closed_rows = true, .closed_columns = true});
  return mesh.finish(false);
}

TestMesh torus(double large, double small) {
  return closed_grid(160, 60, [&](double a, double b) {
    const double distance = large + small * std::cos(b);
    return Point{distance * std::cos(a), distance * std::sin(a), -small * std::sin(b)};
  });
}

/// The height a x^2 + b x y + c y^2 over a square with sides of 2.
TestMesh graph(double a, double b, double c, std::size_t side) {
  TestMesh mesh = make_grid(side, side, false);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    double* const p = &mesh.positions[3 * v];
    const auto unit = [&](double t) { return 2 * t / static_cast<double>(side - 1) - 1; };
    p[0] = unit(p[0]);
    p[1] = unit(p[1]);
    p[2] = a * p[0] * p[0] + b * p[0] * p[1] + c * p[1] * p[1];
  }
  return mesh.finish(false);
}

double relative(double a, double b, double size) { return std::abs(a - b) / size; }

/// The largest difference of the curvatures relative to the larger of a row.
double largest_difference(const Curvatures& a, const Curvatures& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.k1.size(); ++i) {
    const double size = std::max({std::abs(a.k1[i]), std::abs(a.k2[i]), 1e-300});
    worst = std::max({worst, relative(a.k1[i], b.k1[i], size), relative(a.k2[i], b.k2[i], size)});
  }
  return worst;
}

TEST(Curvatures, OfATorusAreThoseOfTheFormula) {
  const WithSurface torus_case = with_surface(torus(3, 1));
  const Curvatures k = curvatures(torus_case.surface, {.radius = 0.35});
  double worst = 0;
  for (std::size_t v = 0; v < torus_case.mesh.size(); ++v) {
    const double* const p = &torus_case.mesh.positions[3 * v];
    const double ring = std::hypot(p[0], p[1]);
    const double around = (ring - 3) / ring;  // cos(b) / (R + r cos(b))
    EXPECT_EQ(k.state[v], CurvatureState::Fitted);
    worst = std::max({worst, std::abs(k.k1[v] - 1), std::abs(k.k2[v] - around)});
    const Point tangent{-p[1] / ring, p[0] / ring, 0};
    const Point d2{k.d2[3 * v], k.d2[3 * v + 1], k.d2[3 * v + 2]};
    EXPECT_NEAR(std::abs(dot(tangent, d2)), 1, 1e-3);
  }
  std::printf("torus: worst absolute error %.3f\n", worst);
  EXPECT_LT(worst, 0.03);
}

TEST(Curvatures, ChangeSignIfTheFacesAreTurned) {
  TestMesh mesh = torus(3, 1);
  const WithSurface one = with_surface(mesh);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::swap(mesh.corners[mesh.offsets[f]], mesh.corners[mesh.offsets[f] + 1]);
  }
  const WithSurface turned = with_surface(mesh);
  const Curvatures a = curvatures(one.surface, {.radius = 0.35});
  Curvatures b = curvatures(turned.surface, {.radius = 0.35});
  std::swap(b.k1, b.k2);
  for (double& k : b.k1) k = -k;
  for (double& k : b.k2) k = -k;
  EXPECT_LT(largest_difference(a, b), 1e-10);
}

TEST(Curvatures, OfAPlaneAre0AlsoAtItsBoundary) {
  for (const bool quads : {false, true}) {
    const WithSurface plane = with_surface(make_grid(30, 30, quads).finish(false));
    for (const CurvatureOptions& options : {CurvatureOptions{}, like_libigl()}) {
      const Curvatures k = curvatures(plane.surface, {.radius = 4.0}, options);
      EXPECT_THAT(k.k1, testing::Each(testing::DoubleEq(0)));
      EXPECT_THAT(k.k2, testing::Each(testing::DoubleEq(0)));
      EXPECT_THAT(k.state, testing::Each(CurvatureState::Fitted));
    }
  }
}

TEST(Curvatures, OfAGraphAreThoseOfItsQuadricWhereTheNormalIsVertical) {
  const WithSurface saddle = with_surface(graph(0.3, 0.4, -0.5, 41));
  const VertexId middle = 20 * 41 + 20;
  const std::vector<VertexId> rows{middle};
  // The shape operator of the height field is -[[2a, b], [b, 2c]].
  const double root = std::hypot(0.8, 0.4);
  for (const CurvatureOptions& options : {CurvatureOptions{}, kUnfilteredJet}) {
    const Curvatures k = curvatures(saddle.surface, {.vertices = rows, .radius = 0.4}, options);
    EXPECT_NEAR(k.k1[0], 0.2 + root, 1e-10);
    EXPECT_NEAR(k.k2[0], 0.2 - root, 1e-10);
  }
}

/// Rows of a mesh of every family against the fit to their points, which shares neither moments nor packets.
void expect_like_points(const Family& family, const CurvatureOptions& options, std::size_t& rows) {
  for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
    const TestMesh mesh = make_mesh(family, seed, 200);
    if (mesh.face_count() == 0) continue;
    const WithSurface one = with_surface(mesh);
    const OrientedIndex state = SurfaceAccess::oriented(one.surface);
    const GraphData graph = extract_graph(one.index);
    const double edge = mean_edge_length(graph.view());
    for (const double edges : {1.5, 3.0, 8.0}) {
      const double radius = edges * edge;
      const Curvatures k = curvatures(one.surface, {.radius = radius}, options);
      DirectFit direct(state, Metric::Straight, options);
      for (std::size_t i = 0; i < one.mesh.size(); ++i) {
        const VertexId v = state.index->id(i);
        const auto place = static_cast<std::uint32_t>(i);
        const Point normal = state.normal(i);
        if (std::isnan(normal.x)) {
          EXPECT_EQ(k.state[v], CurvatureState::NoNormal);
          continue;
        }
        const Point offset = state.position(state.first_neighbor(i)) - state.position(i);
        const TangentFrame frame =
            options.shape_operator == ShapeOperator::Exact ? frame_of(normal) : frame_towards(normal, offset);
        const DirectFit::Result expected =
            direct.fit(place, options.open_ball ? std::nextafter(radius, 0.0) : radius, frame);
        ASSERT_EQ(k.state[v], expected.state) << family.name << ", seed " << seed << ", vertex " << v;
        const double size = std::max(std::abs(expected.curvature.k1), std::abs(expected.curvature.k2));
        constexpr double kLeast = std::numeric_limits<double>::min();  // a family may have edges of length 0 only
        const double tolerance = 1e-9 * size + 1e-10 / std::max(radius, kLeast);  // nearly flat ones have only rounding
        EXPECT_NEAR(k.k1[v], expected.curvature.k1, tolerance) << family.name << ", seed " << seed << ", vertex " << v;
        EXPECT_NEAR(k.k2[v], expected.curvature.k2, tolerance);
        ++rows;
      }
    }
  }
}

TEST(Curvatures, AreThoseOfTheFitToThePointsOnEveryFamily) {
  std::size_t rows = 0;
  for (const Family& family : families()) {
    expect_like_points(family, {}, rows);
    expect_like_points(family, {.filter = false}, rows);
    expect_like_points(family, like_libigl(), rows);
  }
  std::printf("%zu rows\n", rows);
  EXPECT_GT(rows, 1000U);
}

TEST(Curvatures, OfJetsAreThoseOfTheFitToThePoints) {
  for (const TestMesh& mesh : {torus(3, 1), graph(0.2, 0.5, -0.4, 31)}) {
    const WithSurface one = with_surface(mesh);
    const OrientedIndex state = SurfaceAccess::oriented(one.surface);
    const GraphData edges = extract_graph(one.index);
    const double radius = 4 * mean_edge_length(edges.view());
    const Curvatures k = curvatures(one.surface, {.radius = radius}, kUnfilteredJet);
    DirectFit direct(state, Metric::Straight, kUnfilteredJet);
    for (std::size_t i = 0; i < mesh.size(); i += 5) {
      const VertexId v = state.index->id(i);
      const auto expected = direct.fit(static_cast<std::uint32_t>(i), radius, frame_of(state.normal(i)));
      const double size = std::max(std::abs(expected.curvature.k1), std::abs(expected.curvature.k2));
      EXPECT_NEAR(k.k1[v], expected.curvature.k1, 1e-9 * size);
      EXPECT_NEAR(k.k2[v], expected.curvature.k2, 1e-9 * size);
    }
  }
}

TEST(Curvatures, ScaleByPowersOfTwoBitForBit) {
  const TestMesh mesh = bumpy_grid(30).finish(false);
  const WithSurface one = with_surface(mesh);
  for (const CurvatureFit fit : {CurvatureFit::Quadric, CurvatureFit::Jet}) {
    const Curvatures expected = curvatures(one.surface, {.radius = 3.0}, {.fit = fit});
    for (const int exponent : {-480, -400, -300, -3, 5, 300, 480}) {
      TestMesh scaled_mesh = mesh;
      for (double& x : scaled_mesh.positions) x = std::ldexp(x, exponent);
      const WithSurface other = with_surface(scaled_mesh);
      const Curvatures k = curvatures(other.surface, {.radius = std::ldexp(3.0, exponent)}, {.fit = fit});
      for (std::size_t v = 0; v < mesh.size(); ++v) {
        ASSERT_EQ(std::ldexp(k.k1[v], exponent), expected.k1[v]) << "2^" << exponent << ", vertex " << v;
        ASSERT_EQ(std::ldexp(k.k2[v], exponent), expected.k2[v]);
      }
      EXPECT_EQ(k.d1, expected.d1);
      EXPECT_EQ(k.state, expected.state);
    }
  }
}

TEST(Curvatures, DoNotDependOnWhereTheMeshLies) {
  TestMesh mesh = bumpy_grid(30).finish(true);  // floats, so that moving by a whole number is exact
  mesh.finish(false);
  const WithSurface one = with_surface(mesh);
  for (double& x : mesh.positions) x += 0x1p20;
  const WithSurface far = with_surface(mesh);
  EXPECT_LT(largest_difference(curvatures(one.surface, {.radius = 3.0}), curvatures(far.surface, {.radius = 3.0})),
            1e-9);
}

/// Squares of areas underflow in the frame.
TEST(Curvatures, DoNotDependOnAVertexFarAway) {
  TestMesh mesh = bumpy_grid(12).finish(false);
  const WithSurface alone = with_surface(mesh);
  mesh.add_vertex(1e90, 0, 0);
  const WithSurface one = with_surface(mesh.finish(false));
  const Curvatures expected = curvatures(alone.surface, {.radius = 3});
  const Curvatures found = curvatures(one.surface, {.radius = 3});
  const CorrectedCurvatures corrected = corrected_curvatures(alone.surface, {.radius = 3});
  const CorrectedCurvatures found_corrected = corrected_curvatures(one.surface, {.radius = 3});
  for (std::size_t v = 0; v < alone.mesh.size(); ++v) {
    ASSERT_EQ(found.state[v], CurvatureState::Fitted);
    ASSERT_NEAR(found.k1[v], expected.k1[v], 1e-9);
    ASSERT_NEAR(found_corrected.k1[v], corrected.k1[v], 1e-9);
    ASSERT_NEAR(found_corrected.area[v], corrected.area[v], 1e-12 * corrected.area[v]);
  }
}

TEST(Curvatures, DoNotDependOnTheNumbering) {
  Random random(7);
  const TestMesh mesh = torus(3, 1);
  const std::vector<std::uint32_t> place = random.permutation(mesh.size());
  const WithSurface one = with_surface(mesh);
  const WithSurface other = with_surface(renumbered(mesh, place));
  const Curvatures a = curvatures(one.surface, {.radius = 0.4});
  const Curvatures b = curvatures(other.surface, {.radius = 0.4});
  Curvatures back = b;
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    back.k1[v] = b.k1[place[v]];
    back.k2[v] = b.k2[place[v]];
  }
  EXPECT_LT(largest_difference(a, back), 1e-10);
}

TEST(Curvatures, NormalsHaveTheSameBitsForAnyNumberOfThreads) {
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    const TestMesh mesh = make_mesh(family, 5, 300);
    if (mesh.face_count() == 0) continue;
    SCOPED_TRACE(family.name);
    const Index index = build(mesh.view());
    const auto bits = [&](unsigned threads) {
      const Surface surface(index, mesh.view().faces);
      const OrientedIndex state = SurfaceAccess::oriented(surface, threads);
      std::vector<std::uint64_t> all;
      for (const auto* const axis : {&state.normals->x, &state.normals->y, &state.normals->z}) {
        for (const double number : *axis) all.push_back(std::bit_cast<std::uint64_t>(number));
      }
      return all;
    };
    const std::vector<std::uint64_t> expected = bits(1);
    for (const unsigned threads : {2U, 3U, 7U}) EXPECT_EQ(bits(threads), expected) << threads << " threads";
    ++meshes;
  }
  EXPECT_GT(meshes, 15U);
}

/// Memory with values that no curvature has.
struct Poisoned {
  explicit Poisoned(std::size_t rows)
      : k1(rows, 77),
        k2(rows, 77),
        d1(3 * rows, 77),
        d2(3 * rows, 77),
        state(rows, CurvatureState{9}),
        count(rows, 1U << 31) {}

  CurvatureMemory memory() { return {k1, k2, d1, d2, state, count}; }

  std::vector<double> k1, k2, d1, d2;
  std::vector<CurvatureState> state;
  std::vector<std::uint32_t> count;
};

TEST(Curvatures, AreWrittenToAllOfTheMemoryOfTheCaller) {
  const WithSurface one = with_surface(bumpy_grid(30).finish(false));
  std::vector<std::uint8_t> walls(one.surface.vertex_count());
  for (std::size_t v = 100; v < 140; ++v) walls[v] = 1;
  std::vector<std::uint8_t> ignored(one.surface.vertex_count());
  for (std::size_t v = 130; v < 180; ++v) ignored[v] = 1;
  const std::vector<VertexId> rows{17, 110, 899, 135, 450, 170, 110};
  const Surface with_masks = one.surface.on(masked(one.index, {walls, ignored}));
  for (const auto& [surface, query] : {std::pair(&one.surface, BatchQuery{.radius = 3.0}),
                                       {&with_masks, {.radius = 3.0}},
                                       {&with_masks, {.vertices = rows, .radius = 0.0}},
                                       {&one.surface, {.vertices = rows, .radius = 4.0}}}) {
    for (const CurvatureOptions& options :
         {CurvatureOptions{}, like_libigl(), CurvatureOptions{.fit = CurvatureFit::Jet}}) {
      const Curvatures expected = curvatures(*surface, query, options, {.threads = 1});
      Poisoned found(expected.k1.size());
      curvatures(*surface, query, found.memory(), options, {.threads = 3});
      const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), std::as_bytes(std::span(a)).size()) == 0;
      };
      EXPECT_TRUE(same(found.k1, expected.k1));
      EXPECT_TRUE(same(found.k2, expected.k2));
      EXPECT_TRUE(same(found.d1, expected.d1));
      EXPECT_TRUE(same(found.d2, expected.d2));
      EXPECT_EQ(found.state, expected.state);
      EXPECT_EQ(found.count, expected.count);
      for (std::size_t row = 0; row < found.k1.size(); ++row) {
        EXPECT_NE(found.k1[row], 77) << row;
        EXPECT_NE(found.d2[3 * row + 2], 77) << row;
        EXPECT_NE(found.count[row], 1U << 31) << row;
      }
    }
  }
}

TEST(Curvatures, RefuseMemoryOfAnotherSize) {
  const WithSurface one = with_surface(bumpy_grid(5).finish(false));
  const std::size_t rows = one.surface.vertex_count();
  Poisoned whole(rows);
  const auto expect_refusal = [&](const std::string& array, auto change) {
    CurvatureMemory memory = whole.memory();
    change(memory);
    expect_refused(ErrorCode::InvalidOption, "memory for " + array,
                   [&] { curvatures(one.surface, {.radius = 3.0}, memory); });
    EXPECT_EQ(whole.k1.front(), 77);
  };
  const std::string less = std::to_string(rows - 1) + " elements of ";
  const std::string third = std::to_string(rows) + " elements of ";
  const std::string expected = ", expected for " + std::to_string(rows);
  const std::string thrice = ", expected for " + std::to_string(3 * rows);
  expect_refusal(less + "k1" + expected, [&](CurvatureMemory& m) { m.k1 = m.k1.first(rows - 1); });
  expect_refusal(less + "k2" + expected, [&](CurvatureMemory& m) { m.k2 = m.k2.first(rows - 1); });
  expect_refusal(third + "d1" + thrice, [&](CurvatureMemory& m) { m.d1 = m.d1.first(rows); });
  expect_refusal(third + "d2" + thrice, [&](CurvatureMemory& m) { m.d2 = m.d2.first(rows); });
  expect_refusal(less + "state" + expected, [&](CurvatureMemory& m) { m.state = m.state.first(rows - 1); });
  expect_refusal(less + "count" + expected, [&](CurvatureMemory& m) { m.count = m.count.first(rows - 1); });
}

TEST(Curvatures, TheFilterKeepsTheOtherSideOfAFoldOut) {
  // Two plates, one above the other and turned away from it, joined at one side.
  TestMesh mesh = make_grid(20, 20, false);
  const std::size_t size = mesh.size();
  for (std::size_t v = 0; v < size; ++v) {
    const double* const p = &mesh.positions[3 * v];
    mesh.add_vertex(p[0], p[1], -0.5);
  }
  const std::size_t faces = mesh.face_count();
  for (std::size_t f = 0; f < faces; ++f) {
    std::vector<std::uint32_t> face(mesh.face(f).rbegin(), mesh.face(f).rend());
    for (std::uint32_t& v : face) v += static_cast<std::uint32_t>(size);
    mesh.add_face(face);
  }
  for (std::uint32_t i = 0; i + 1 < 20; ++i) {
    const auto below = static_cast<std::uint32_t>(size) + i;
    mesh.add_face({i, i + 1, below + 1, below});
  }
  const WithSurface plates = with_surface(mesh.finish(false));
  const std::vector<VertexId> rows{5 * 20 + 10, 6 * 20 + 10, 14 * 20 + 10};
  const Curvatures with = curvatures(plates.surface, {.vertices = rows, .radius = 8.0});
  const Curvatures without = curvatures(plates.surface, {.vertices = rows, .radius = 8.0}, {.filter = false});
  EXPECT_GT(std::abs(without.k1[0]) + std::abs(without.k2[0]), 1e-3);
  EXPECT_LT(std::abs(with.k1[0]) + std::abs(with.k2[0]), 0.02);
  EXPECT_LT(std::abs(with.k1[2]) + std::abs(with.k2[2]), 1e-12);
}

TEST(Curvatures, ReportTheStateOfEachRow) {
  // A fan of five vertices, a strip of six on a line, an isolated vertex, and a face without area.
  TestMesh mesh;
  for (int i = 0; i < 5; ++i) mesh.add_vertex(i, i % 2, 0);
  for (std::uint32_t i = 0; i + 2 < 5; ++i) mesh.add_face({i, i + 1, i + 2});
  const auto isolated = mesh.add_vertex(100, 0, 0);
  const auto flat = mesh.add_vertex(200, 0, 0);
  mesh.add_vertex(201, 0, 0);
  mesh.add_vertex(202, 0, 0);
  mesh.add_face({flat, flat + 1, flat + 2});
  const WithSurface one = with_surface(mesh.finish(false));
  const Curvatures k = curvatures(one.surface, {.radius = std::numeric_limits<double>::infinity()});
  EXPECT_EQ(k.state[0], CurvatureState::TooFew);
  EXPECT_EQ(k.state[isolated], CurvatureState::NoNormal);
  EXPECT_EQ(k.state[flat], CurvatureState::NoNormal);
  EXPECT_THAT(k.k1, testing::Each(0));
  EXPECT_THAT(k.d1, testing::Each(0));
}

TEST(Curvatures, ANeighborhoodOfFewerThanSixVerticesIsExtended) {
  const WithSurface one = with_surface(bumpy_grid(12).finish(false));
  const Curvatures none = curvatures(one.surface, {.radius = 0.0});
  EXPECT_THAT(none.state, testing::Each(testing::AnyOf(CurvatureState::Extended, CurvatureState::RankDeficient)));
  EXPECT_THAT(none.state, testing::Contains(CurvatureState::Extended));
  EXPECT_THAT(none.count, testing::Each(1));
  EXPECT_THAT(none.k1, testing::Contains(testing::Ne(0)));
}

TEST(Curvatures, CountTheVerticesThatAreFitted) {
  const WithSurface one = with_surface(torus(3, 1));
  Searcher searcher(one.index);
  for (const double radius : {0.1, 0.3, 0.5}) {
    const Curvatures found = curvatures(one.surface, {.radius = radius}, {.filter = false});
    for (VertexId v = 0; v < one.mesh.size(); ++v) {
      ASSERT_EQ(found.count[v], searcher.count(v, radius));
      ASSERT_EQ(found.state[v] == CurvatureState::Fitted, found.count[v] >= 6) << "vertex " << v;
    }
  }
}

TEST(Curvatures, GivenNormalsReplaceFaces) {
  const WithSurface one = with_surface(torus(3, 1));
  const OrientedIndex state = SurfaceAccess::oriented(one.surface);
  std::vector<double> normals(3 * one.mesh.size());
  for (std::size_t i = 0; i < one.mesh.size(); ++i) {
    const VertexId v = state.index->id(i);
    normals[3 * v] = 1e200 * state.normals->x[i];
    normals[3 * v + 1] = 1e200 * state.normals->y[i];
    normals[3 * v + 2] = 1e200 * state.normals->z[i];
  }
  const Surface given = Surface::of_normals(one.index, normals);
  EXPECT_LT(largest_difference(curvatures(one.surface, {.radius = 0.4}), curvatures(given, {.radius = 0.4})), 1e-12);
}

TEST(Curvatures, AVertexWithANormalOfNanHasNoNormal) {
  const WithSurface one = with_surface(bumpy_grid(12).finish(false));
  std::vector<double> normals(3 * one.mesh.size());
  for (std::size_t v = 0; v < one.mesh.size(); ++v) normals[3 * v + 2] = 1;
  normals[3 * 77 + 1] = std::nan("");
  const Curvatures k = curvatures(Surface::of_normals(one.index, normals), {.radius = 3.0});
  for (std::size_t v = 0; v < one.mesh.size(); ++v) {
    EXPECT_EQ(k.state[v], v == 77 ? CurvatureState::NoNormal : CurvatureState::Fitted);
    EXPECT_TRUE(std::isfinite(k.k1[v]) && std::isfinite(k.k2[v]));
  }
  EXPECT_EQ(k.k1[77], 0);
}

TEST(Curvatures, LibiglsAxisPointsToTheNeighborWithTheLowestId) {
  const TestMesh mesh = renumbered(bumpy_grid(9).finish(false), Random(3).permutation(81));
  const WithSurface one = with_surface(mesh);
  const OrientedIndex state = SurfaceAccess::oriented(one.surface);
  const Adjacency edges = adjacency(one.mesh.view());
  for (std::size_t i = 0; i < one.mesh.size(); ++i) {
    const auto neighbors = edges.view()[state.index->id(i)];
    EXPECT_EQ(state.index->id(state.first_neighbor(i)), *std::min_element(neighbors.begin(), neighbors.end()));
  }
}

TEST(Curvatures, AnOpenBallHasNoVertexAtExactlyTheRadius) {
  // On a plane with one raised vertex at exactly the radius, only the closed ball sees it.
  TestMesh mesh = make_grid(21, 21, false);
  const VertexId middle = 10 * 21 + 10;
  mesh.positions[3 * (middle + 6) + 2] = 8;
  const double radius = 10;  // 6, 0, 8
  const WithSurface one = with_surface(mesh.finish(false));
  const std::vector<VertexId> rows{middle};
  EXPECT_NE(curvatures(one.surface, {.vertices = rows, .radius = radius}, {.filter = false}).k1[0], 0);
  EXPECT_EQ(curvatures(one.surface, {.vertices = rows, .radius = radius}, {.filter = false, .open_ball = true}).k1[0],
            0);
}

TEST(Curvatures, RefuseInvalidArgumentsAndNameThem) {
  const WithSurface one = with_surface(bumpy_grid(5).finish(false));
  TestMesh moved = one.mesh;
  moved.positions[3 * 7] += 1;
  TestMesh smaller = bumpy_grid(4).finish(false);
  const MeshView no_faces{one.mesh.positions_view(), FacesView()};
  std::vector<double> normals(3 * one.mesh.size(), 1.0);
  expect_refused(ErrorCode::InvalidMesh, "vertex 7", [&] { return Surface(one.index, moved.view()); });
  expect_refused(ErrorCode::InvalidMesh, "16 vertices", [&] { return Surface(one.index, smaller.view()); });
  expect_refused(ErrorCode::InvalidMesh, "no faces",
                 [&] { return curvatures(Surface(one.index, no_faces), {.radius = 1.0}); });
  expect_refused(ErrorCode::InvalidMesh, "expected faces, also with normals",
                 [&] { return corrected_curvatures(Surface(one.index, no_faces), {.radius = 1.0}); });
  expect_refused(ErrorCode::InvalidRadius, "edges: radius -1", [&] { return libigl_radius(one.mesh.view(), -1); });
  expect_refused(ErrorCode::InvalidMesh, "25 vertices",
                 [&] { return Surface::of_normals(one.index, std::span(normals).first(3)); });
  normals[3 * 4 + 1] = -std::numeric_limits<double>::infinity();
  expect_refused(ErrorCode::InvalidMesh, "vertex 4", [&] { return Surface::of_normals(one.index, normals); });
  expect_refused(ErrorCode::InvalidRadius, "-1", [&] { return curvatures(one.surface, {.radius = -1.0}); });
  expect_refused(ErrorCode::InvalidRadius, "-1",
                 [&] { return curvatures(one.surface, {.radius = -1.0}, like_libigl()); });
  expect_refused(ErrorCode::InvalidOption, "thread",
                 [&] { return curvatures(one.surface, {.radius = 1.0}, {}, {.threads = kMaxThreads + 1}); });
  expect_refused(ErrorCode::InvalidOption, "not the jet", [&] {
    return curvatures(one.surface, {.radius = 1.0},
                      {.shape_operator = ShapeOperator::Libigl, .fit = CurvatureFit::Jet});
  });
  expect_refused(ErrorCode::Cancelled, "cancel", [&] {
    return curvatures(one.surface, {.radius = 1.0}, {}, {.progress = [](std::size_t, std::size_t) { return false; }});
  });
}

TEST(Curvatures, LibiglsRadiusCountsInnerEdgesTwice) {
  TestMesh mesh;
  mesh.add_vertex(0, 0, 0);
  mesh.add_vertex(1, 0, 0);
  mesh.add_vertex(0, 1, 0);
  mesh.add_vertex(1, 1, 0);
  mesh.add_face({0, 1, 2});
  mesh.add_face({2, 1, 3});
  mesh.finish(false);
  EXPECT_DOUBLE_EQ(libigl_radius(mesh.view(), 3), 3 * (4 + 2 * std::sqrt(2)) / 6);
}

TEST(Curvatures, ShapeIndexAndCurvednessAreThoseOfKoenderink) {
  EXPECT_DOUBLE_EQ(shape_index(1, 1), 1);
  EXPECT_DOUBLE_EQ(shape_index(1, 0), 0.5);
  EXPECT_DOUBLE_EQ(shape_index(1, -1), 0);
  EXPECT_DOUBLE_EQ(shape_index(0, -1), -0.5);
  EXPECT_DOUBLE_EQ(shape_index(-2, -2), -1);
  EXPECT_TRUE(std::isnan(shape_index(0, 0)));
  EXPECT_DOUBLE_EQ(curvedness(3, -3), 3);
  EXPECT_DOUBLE_EQ(curvedness(1e200, 1e200), 1e200);
  EXPECT_EQ(curvedness(0, 0), 0);
}

}  // namespace
}  // namespace meshhood::test
