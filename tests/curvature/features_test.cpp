// SPDX-License-Identifier: MIT
// Features over several radii, and over how many radii they last.
#include "meshhood/features.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/index.h"
#include "meshhood/masks.h"
#include "meshhood/moments.h"
#include "meshhood/patch.h"

#include "support/families.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class BumpyFeatures : public testing::Test {
 protected:
  TestMesh mesh = bumpy_grid(20).finish(false);
  Index index = build(mesh.view());
  Surface surface{index, mesh.view()};
  std::vector<double> areas = vertex_areas(mesh.view());
  std::vector<double> radii{2.0, 3.5, 5.0};
};

TEST_F(BumpyFeatures, AreCurvaturesTimesTheRadius) {
  const std::vector<double> found =
      features(surface, {{}, BatchRadius::scales(radii)},
               {.kinds = {Feature::K1, Feature::K2, Feature::Crease, Feature::Gaussian, Feature::ShapeIndex}});
  const std::size_t vertices = mesh.size();
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double r = radii[i];
    const Curvatures k = curvatures(surface, {.radius = r});
    for (std::size_t v = 0; v < vertices; ++v) {
      const double* const of_row = &found[5 * (i * vertices + v)];
      ASSERT_EQ(of_row[0], r * k.k1[v]);
      ASSERT_EQ(of_row[1], r * k.k2[v]);
      ASSERT_EQ(of_row[2], std::abs(k.k1[v]) >= std::abs(k.k2[v]) ? of_row[0] : of_row[1]);
      ASSERT_EQ(of_row[3], of_row[0] * of_row[1]);
      ASSERT_NEAR(of_row[4], shape_index(k.k1[v], k.k2[v]), 1e-12);
    }
  }
}

TEST_F(BumpyFeatures, OfMomentsAreThoseOfPrincipalComponents) {
  const std::vector<VertexId> rows{210, 5, 399};
  const std::vector<double> found = features(surface, {rows, BatchRadius::scales(radii)},
                                             {.kinds = {Feature::Crease, Feature::Variation}, .areas = areas});
  const PrincipalComponents patch =
      principal_components(index, {.vertices = rows, .radius = radii[1]}, {.weights = areas});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    EXPECT_EQ(found[2 * (1 * rows.size() + row) + 1],
              surface_variation(patch.variances[3 * row], patch.variances[3 * row + 1], patch.variances[3 * row + 2]));
  }
}

/// Of an index with ignored vertices, too, of which patches are searched apart from the others.
TEST_F(BumpyFeatures, OfSeveralKindsHaveTheBitsOfEach) {
  std::vector<std::uint8_t> ignored(mesh.size());
  for (std::size_t v = 0; v < ignored.size(); v += 7) ignored[v] = 1;
  std::vector<Feature> kinds;
  for (int kind = 0; kind <= static_cast<int>(Feature::Variation); ++kind) kinds.push_back(static_cast<Feature>(kind));
  std::vector<VertexId> rows(scaled(mesh.size(), 100));
  std::iota(rows.begin(), rows.end(), 0);
  const BatchQuery query{.vertices = rows, .radius = BatchRadius::scales(radii)};
  const auto compare = [&](const Surface& of) {
    std::size_t most = 0;
    std::size_t end = 0;
    const auto count = [&](std::size_t done, std::size_t total) {
      EXPECT_GE(done, std::exchange(most, done));
      end = total;
      return true;
    };
    const std::vector<double> together = features(of, query, {.kinds = kinds}, {.threads = 2, .progress = count});
    EXPECT_EQ(most, end);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::vector<double> alone = features(of, query, {.kinds = {kinds[k]}});
      ASSERT_EQ(together.size(), kinds.size() * alone.size());
      for (std::size_t i = 0; i < alone.size(); ++i) {
        const double found = together[i * kinds.size() + k];
        ASSERT_TRUE(found == alone[i] || (std::isnan(found) && std::isnan(alone[i])))
            << "kind " << k << ", number " << i;
      }
    }
  };
  compare(surface);
  compare(Surface(masked(index, {.ignored = ignored}), mesh.view()));
}

/// The corner of a cube, cut off, and its mirror image 0.2 above.
TestMesh two_corners() {
  TestMesh mesh;
  for (const double side : {-1.0, 1.0}) {
    const std::uint32_t o = mesh.add_vertex(0, 0, 0.1 + side * 0.1);
    const std::uint32_t x = mesh.add_vertex(1, 0, 0.1 + side * 0.1);
    const std::uint32_t y = mesh.add_vertex(0, 1, 0.1 + side * 0.1);
    const std::uint32_t z = mesh.add_vertex(0, 0, 0.1 + side * 1.1);
    const bool is_upper = side > 0;
    for (const auto& face : {std::array{o, x, y}, std::array{o, z, x}, std::array{o, y, z}, std::array{x, z, y}}) {
      mesh.add_face({face[0], face[is_upper ? 2 : 1], face[is_upper ? 1 : 2]});
    }
  }
  return mesh.finish(false);
}

TEST(Features, OfPatchesAreInvariantsAndGapsWithoutUnit) {
  const auto [mesh, index, surface] = with_surface(two_corners());
  const std::vector<VertexId> rows{0, 4};
  const FeatureOptions options{.kinds = {Feature::Gap, Feature::Gaussian, Feature::Volume, Feature::Area}};
  const std::vector<double> found = features(surface, {rows, BatchRadius::scales({0.1, 0.4})}, options);
  ASSERT_EQ(found.size(), 16);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(found[4 * i + 2], 1.0 / 8, 1e-14);
    EXPECT_NEAR(found[4 * i + 3], 3.0 / 4, 1e-14);
    EXPECT_TRUE(i < 2 ? std::isnan(found[4 * i]) : std::abs(found[4 * i] - 0.5) < 1e-14);
  }
  std::vector<std::size_t> totals;
  const std::vector<double> own{0.4, 0.1};
  const std::vector<double> by_row =
      features(surface, {rows, own}, options, {.threads = 2, .progress = [&](std::size_t, std::size_t total) {
                                                 totals.push_back(total);
                                                 return true;
                                               }});
  EXPECT_EQ(by_row[0], found[8]) << "a radius for each row";
  EXPECT_TRUE(std::isnan(by_row[4]));
  EXPECT_EQ(by_row[2], found[10]);
  EXPECT_EQ(by_row[7], found[7]);
  EXPECT_THAT(totals, testing::Each(2U)) << "curvatures and patches share a search";
}

/// The volumes themselves overflow and underflow.
TEST(Features, OfPatchesDoNotDependOnTheUnit) {
  const auto in_unit = [](int exponent) {
    TestMesh given = two_corners();
    for (double& x : given.positions) x = std::ldexp(x, exponent);
    const WithSurface one = with_surface(given);
    return features(one.surface, {{}, std::ldexp(0.4, exponent)},
                    {.kinds = {Feature::Volume, Feature::Area, Feature::Gap}});
  };
  EXPECT_THAT(in_unit(-400), testing::Pointwise(testing::NanSensitiveDoubleEq(), in_unit(0)));
  EXPECT_THAT(in_unit(400), testing::Pointwise(testing::NanSensitiveDoubleEq(), in_unit(0)));
}

TEST_F(BumpyFeatures, OfPatchesHaveNoVolumeAtABorderAndNoFacesBehindWalls) {
  const FeatureOptions kinds{.kinds = {Feature::Area, Feature::Volume}};
  const std::vector<VertexId> rows{0, 210};  // a corner, and in the middle
  const std::vector<double> found = features(surface, {rows, 2.0}, kinds);
  EXPECT_TRUE(found[0] > 0 && std::isnan(found[1]));
  EXPECT_TRUE(found[2] > 0 && found[3] > 0);
  std::vector<std::uint8_t> walls(mesh.size());
  walls[211] = 1;
  const std::vector<double> walled = features(surface.on(masked(index, {.walls = walls})), {rows, 2.0}, kinds);
  EXPECT_LT(walled[2], found[2]);
  EXPECT_TRUE(std::isnan(walled[3]));
  walls.assign(walls.size(), 1);
  const std::vector<double> none = features(surface.on(masked(index, {.walls = walls})), {rows, 2.0}, kinds);
  EXPECT_TRUE(std::isnan(none[0]) && std::isnan(none[1]));
}

TEST(Features, TheHeightOfASphereIsItsRadiusTimesTheMeanCurvature) {
  // A cap of the sphere of radius 50 around its pole, as a graph.
  TestMesh mesh = make_grid(41, 41, false);
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    double* const p = &mesh.positions[3 * v];
    p[0] -= 20;
    p[1] -= 20;
    p[2] = std::sqrt(2500 - p[0] * p[0] - p[1] * p[1]);
  }
  mesh.finish(false);
  const Index index = build(mesh.view());
  const std::vector<double> areas = vertex_areas(mesh.view());
  const std::vector<VertexId> rows{20 * 41 + 20};
  const std::vector<double> radii{12.0};
  const Surface surface(index, mesh.view());
  const std::vector<double> found = features(surface, {rows, BatchRadius::scales(radii)},
                                             {.kinds = {Feature::Height, Feature::Mean}, .areas = areas});
  EXPECT_NEAR(std::abs(found[1]), 12.0 / 50, 0.01);
  EXPECT_NEAR(found[0], found[1], 0.02);
}

TEST_F(BumpyFeatures, DoNotDependOnTheUnit) {
  TestMesh tiny = mesh;
  for (double& x : tiny.positions) x = std::ldexp(x, -200);
  const Index tiny_index = build(tiny.view());
  std::vector<double> tiny_radii = radii;
  for (double& r : tiny_radii) r = std::ldexp(r, -200);
  EXPECT_EQ(features(Surface(tiny_index, tiny.view()), {{}, BatchRadius::scales(tiny_radii)}, {}, {.threads = 2}),
            features(surface, {{}, BatchRadius::scales(radii)}));
}

TEST(Features, OfAVertexWithoutNormalAreNan) {
  TestMesh mesh = bumpy_grid(6);
  mesh.add_vertex(100, 0, 0);
  mesh.finish(false);
  const Index index = build(mesh.view());
  const std::vector<double> areas = vertex_areas(mesh.view());
  const std::vector<double> radii{2.0};
  const std::vector<double> found = features(Surface(index, mesh.view()), {{}, BatchRadius::scales(radii)},
                                             {.kinds = {Feature::Crease, Feature::Area}, .areas = areas});
  EXPECT_TRUE(std::isnan(found[2 * 36]) && std::isnan(found[2 * 36 + 1]));
  EXPECT_FALSE(std::isnan(found[0]));
}

TEST(Features, RadiiAreSpacedAsTheNameSays) {
  const std::vector<double> radii = geometric_radii(1, 16, 5);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(radii[i], std::exp2(static_cast<double>(i)), 1e-13);
  EXPECT_EQ(radii.back(), 16);
  EXPECT_THAT(geometric_radii(1, 16, 1), testing::ElementsAre(16));
}

TEST(Features, RadiiFromTheLeastNumberToTheLargest) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kMost = std::numeric_limits<double>::max();
  for (const std::size_t count : {2U, 3U, 4U, 1000U}) {
    const std::vector<double> radii = geometric_radii(kLeast, kMost, count);
    EXPECT_EQ(radii.front(), kLeast);
    EXPECT_EQ(radii.back(), kMost);
    const double octaves = (std::log2(kMost) - std::log2(kLeast)) / static_cast<double>(count - 1);
    for (std::size_t i = 1; i < count; ++i) {
      EXPECT_LT(radii[i - 1], radii[i]);
      if (radii[i - 1] < std::numeric_limits<double>::min()) continue;  // of few digits
      EXPECT_NEAR(std::log2(radii[i]) - std::log2(radii[i - 1]), octaves, 1e-11);
    }
  }
  const std::vector<double> one = geometric_radii(0.3, 7, 9);
  const std::vector<double> small = geometric_radii(std::ldexp(0.3, -900), std::ldexp(7, -900), 9);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(std::ldexp(one[i], -900), small[i]) << "the unit is a power of two";
  EXPECT_THAT(geometric_radii(5, 5, 3), testing::ElementsAre(5, 5, 5));
}

TEST(Features, PersistIsTheLongestRunOfOneSign) {
  const std::vector<double> radii{1, 2, 4, 8, 16};
  const auto of = [&](const std::vector<double>& values) { return persistence(values, radii, 0.5); };
  const Persistence one = of({0.5, 0.9, 0.7, 0.4, 0.6});
  EXPECT_EQ(one.scales[0], 3);
  EXPECT_EQ(one.strength[0], 0.9);
  EXPECT_EQ(one.radius[0], 2);
  const Persistence valley = of({0.8, -0.6, -2, -0.5, kNan});
  EXPECT_EQ(valley.scales[0], -3);
  EXPECT_EQ(valley.strength[0], -2);
  EXPECT_EQ(valley.radius[0], 4);
  EXPECT_EQ(of({1, 1, 0, 1, 2}).radius[0], 1) << "of two runs of one length the first";
  EXPECT_EQ(of({1, -1, 1, -1, 1}).scales[0], 1);
  const Persistence none = of({0.1, kNan, -0.4, 0, 0.2});
  EXPECT_EQ(none.scales[0], 0);
  EXPECT_EQ(none.radius[0], 0);
  const Persistence two = persistence(std::vector<double>{1, 0, 1, -1}, std::vector<double>{1, 2}, 0.5);
  EXPECT_THAT(two.scales, testing::ElementsAre(2, -1));
}

TEST_F(BumpyFeatures, RefuseInvalidArgumentsAndNameThem) {
  const auto of = [&](const std::vector<double>& given, const FeatureOptions& options) {
    return features(surface, {{}, BatchRadius::scales(given)}, options);
  };
  expect_refused(ErrorCode::InvalidOption, "no kinds", [&] { return of({1.0}, {.kinds = {}}); });
  expect_refused(ErrorCode::InvalidOption, "no radii", [&] { return of({}, {}); });
  expect_refused(ErrorCode::InvalidRadius, "radius 1: 0", [&] { return of({1.0, 0.0}, {}); });
  expect_refused(ErrorCode::InvalidRadius, "inf", [&] { return of({std::numeric_limits<double>::infinity()}, {}); });
  EXPECT_EQ(of({1.0}, {.kinds = {Feature::Height}}), of({1.0}, {.kinds = {Feature::Height}, .areas = areas}));
  const std::vector<double> normals(3 * mesh.size(), 1.0);
  expect_refused(ErrorCode::InvalidOption, "need `areas`", [&] {
    return features(Surface::of_normals(index, normals), {{}, 1.0}, {.kinds = {Feature::Height}});
  });
  for (const Feature kind : {Feature::Area, Feature::Volume, Feature::Gap}) {
    expect_refused(ErrorCode::InvalidOption, "expected a surface with faces", [&] {
      return features(Surface::of_normals(index, normals), {{}, 1.0}, {.kinds = {kind}, .areas = areas});
    });
    expect_refused(ErrorCode::InvalidOption, "expected the straight metric",
                   [&] { return features(surface, {{}, 1.0, Metric::Path}, {.kinds = {kind}}); });
  }
  expect_refused(ErrorCode::InvalidOption, "0 radii", [&] { return geometric_radii(1, 2, 0); });
  expect_refused(ErrorCode::InvalidRadius, "-1", [&] { return geometric_radii(-1, 1, 2); });
  expect_refused(ErrorCode::InvalidRadius, "the smallest radius is 2", [&] { return geometric_radii(2, 1, 3); });
  const std::vector<double> values(4);
  for (const auto& [wrong, why] : {std::pair(std::vector{2.0, 1.0}, "radii: value 1: radius 1, expected more than 2"),
                                   {{-1.0, 1.0}, "radii: value 0: radius -1"},
                                   {{kNan, 1.0}, "radii: value 0: radius nan"}}) {
    expect_refused(ErrorCode::InvalidRadius, why, [&] { return persistence(values, wrong, 1); });
  }
  const std::vector<double> below(mesh.size(), -1.0);
  expect_refused(ErrorCode::InvalidOption, "areas: vertex 0 has -1",
                 [&] { return of({1.0}, {.kinds = {Feature::Height}, .areas = below}); });
  expect_refused(ErrorCode::InvalidOption, "threshold 0", [&] { return persistence({}, std::vector<double>{1}, 0); });
  expect_refused(ErrorCode::InvalidOption, "3 values",
                 [&] { return persistence(std::span(values).first(3), std::vector<double>{1, 2}, 1); });
  expect_refused(ErrorCode::Cancelled, "cancel", [&] {
    return features(surface, {{}, BatchRadius::scales({1.0, 2.0})}, {},
                    {.progress = [](std::size_t done, std::size_t total) { return done < total / 2; }});
  });
}

}  // namespace
}  // namespace meshhood::test
