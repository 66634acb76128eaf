// SPDX-License-Identifier: MIT
// Moments and principal components, compared with sums over the vertices that breadth-first search finds.
#include "meshhood/moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/index.h"

#include "base/vector.h"
#include "curvature/symmetric.h"
#include "support/families.h"
#include "support/indexed.h"
#include "support/oracle.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

long double power(double x, unsigned n) {
  long double result = 1;
  for (unsigned i = 0; i < n; ++i) result *= static_cast<long double>(x);
  return result;
}

std::vector<double> some_weights(Random& random, std::size_t count) {
  std::vector<double> weights;
  for (std::size_t v = 0; v < count; ++v) weights.push_back(random.below(5) == 0 ? 0 : random.uniform(0, 3));
  return weights;
}

/// The moments of one row by their definition, and the errors that rounding allows.
struct Expected {
  std::vector<long double> sums = std::vector<long double>(moment_count(kLargestMomentDegree));
  std::vector<long double> sizes = sums;
};

Expected moments_of(const TestMesh& mesh, const std::vector<std::uint32_t>& ids, std::uint32_t v,
                    const std::vector<double>& weights) {
  Expected expected;
  for (const std::uint32_t w : ids) {
    std::array<double, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = mesh.positions[3 * w + axis] - mesh.positions[3 * v + axis];
    const double size = std::hypot(p[0], p[1], p[2]);
    for (unsigned i = 0; i <= 4; ++i) {
      for (unsigned j = 0; i + j <= 4; ++j) {
        for (unsigned k = 0; i + j + k <= 4; ++k) {
          const std::size_t column = moment_column(i, j, k);
          const long double weight = weights.empty() ? 1 : static_cast<long double>(weights[w]);
          expected.sums[column] += weight * power(p[0], i) * power(p[1], j) * power(p[2], k);
          expected.sizes[column] += weight * power(size, i + j + k);
        }
      }
    }
  }
  return expected;
}

/// A curved patch of 24 by 24 vertices of spacing 0.01, joined at its corners to four faces of size `far`. Some of its
/// leaves hold far vertices, too.
TestMesh graded_mesh(double far) {
  constexpr std::uint32_t kSide = 24;
  TestMesh mesh;
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const double x = 0.01 * i;
      const double y = 0.01 * j;
      mesh.add_vertex(x, y, 0.3 * x + 2 * (x * x + y * y));
    }
  }
  for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
    for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
      const std::uint32_t v = i * kSide + j;
      mesh.add_face({v, v + 1, v + kSide + 1, v + kSide});
    }
  }
  const std::uint32_t first = kSide * kSide;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) mesh.add_vertex(x * far, y * far, 0);
  const std::array<std::uint32_t, 4> corners{0, (kSide - 1) * kSide, kSide * kSide - 1, kSide - 1};
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.add_face({first + i, first + (i + 1) % 4, corners[(i + 1) % 4], corners[i]});
  }
  return mesh.finish(false);
}

class MomentsOfAGradedMesh : public testing::TestWithParam<double> {};

TEST_P(MomentsOfAGradedMesh, KeepTheirBound) {
  const TestMesh mesh = graded_mesh(GetParam());
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  const std::vector<double> areas = vertex_areas(mesh.view());  // of the corners 10^14 times those of the patch
  const std::size_t rows = scaled(mesh.size(), 24);
  double worst = 0;
  for (const double radius : {0.0, 0.011, 0.05, 0.3}) {
    for (const std::vector<double>& weights : {std::vector<double>(), areas}) {
      const std::vector<double> found = moments(index, {.radius = radius}, {.degree = 4, .weights = weights});
      for (std::size_t row = 0; row < rows; ++row) {
        const auto v = static_cast<VertexId>(mesh.size() - 1 - row * mesh.size() / rows);  // the first is far away
        const Expected expected = moments_of(mesh, oracle.exact(v, radius), v, weights);
        for (std::size_t column = 0; column < 35; ++column) {
          const double error = std::abs(static_cast<double>(found[35 * v + column] - expected.sums[column]));
          const auto size = static_cast<double>(expected.sizes[column]);
          ASSERT_LE(error, 1e-13 * size) << "vertex " << v << ", radius " << radius << ", column " << column;
          if (size > 0) worst = std::max(worst, error / size);
        }
      }
    }
  }
  std::printf("%zu vertices, largest error %.1e\n", rows, worst);
}

INSTANTIATE_TEST_SUITE_P(Sizes, MomentsOfAGradedMesh, testing::Values(1, 1e2, 1e4, 1e6));

TEST(Moments, OfTinyNeighborhoodsAreThoseOfTheirVertices) {
  const auto [mesh, index] = indexed(bumpy_grid(12).finish(false));
  std::vector<double> radii(mesh.size(), 3.0);
  for (std::size_t v = 0; v < radii.size(); v += 7) radii[v] = 1e-320;
  const std::vector<double> found = moments(index, {.radius = radii}, {.degree = 4});
  const Oracle oracle(mesh);
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const Expected expected = moments_of(mesh, oracle.exact(v, radii[v]), v, {});
    for (std::size_t column = 0; column < 35; ++column) {
      ASSERT_NEAR(found[35 * v + column], static_cast<double>(expected.sums[column]),
                  1e-13 * static_cast<double>(expected.sizes[column]))
          << "vertex " << v << ", column " << column;
    }
  }
}

/// Leaves of the vertices at one point have no extent, and powers of their rings underflow in the unit of the frame.
TEST(Moments, OfRingsOfVerticesAtOnePointDoNotDependOnAVertexFarAway) {
  TestMesh mesh;
  constexpr std::uint32_t kSame = 100;
  for (std::uint32_t v = 0; v < 2 * kSame; ++v) mesh.add_vertex(v < kSame ? 0 : 1, 0, 0);
  for (std::uint32_t v = 0; v < kSame; ++v) mesh.add_face({v, v + kSame});
  for (std::uint32_t v = 1; v < kSame; ++v) {
    mesh.add_face({v - 1, v});
    mesh.add_face({v + kSame - 1, v + kSame});
  }
  mesh.add_vertex(1e120, 0, 0);
  const auto [finished, index] = indexed(mesh.finish(false));
  const std::vector<double> found = moments(index, {.radius = 1, .metric = Metric::Rings}, {.degree = 4});
  for (std::size_t v = 0; v < kSame; ++v) {
    for (unsigned degree = 1; degree <= 4; ++degree) ASSERT_EQ(found[35 * v + moment_column(degree, 0, 0)], 1);
  }
}

TEST(Moments, OfDenormalPositionsAreExact) {
  TestMesh mesh = make_grid(12, 12, true).finish(false);
  for (double& x : mesh.positions) x *= 0x1p-1070;
  const Oracle oracle(mesh);
  const std::vector<double> found = moments(build(mesh.view()), {.radius = 0x1p-1069}, {.degree = 1});
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const Expected expected = moments_of(mesh, oracle.exact(v, 0x1p-1069), v, {});
    for (std::size_t column = 0; column < 4; ++column) {
      ASSERT_EQ(found[4 * v + column], static_cast<double>(expected.sums[column])) << "vertex " << v;
    }
  }
}

TEST(Moments, OfALowerDegreeAreTheFirstColumns) {
  const auto [mesh, index] = indexed(bumpy_grid(15).finish(false));
  const std::vector<double> all = moments(index, {.radius = 3.0}, {.degree = 4});
  for (const unsigned degree : {0U, 1U, 2U, 3U}) {
    const std::vector<double> some = moments(index, {.radius = 3.0}, {.degree = degree}, {.threads = 2});
    const std::size_t columns = moment_count(degree);
    ASSERT_EQ(some.size(), columns * mesh.size());
    for (std::size_t i = 0; i < some.size(); ++i) ASSERT_EQ(some[i], all[35 * (i / columns) + i % columns]);
  }
}

TEST(Moments, ScaleByPowersOfTwoBitForBit) {
  const TestMesh mesh = bumpy_grid(12).finish(false);
  const std::vector<double> expected = moments(build(mesh.view()), {.radius = 3.0}, {.degree = 4});
  for (const int exponent : {-100, 100}) {
    TestMesh other = mesh;
    for (double& x : other.positions) x = std::ldexp(x, exponent);
    const std::vector<double> weights(mesh.size(), 0x1p-300);
    const std::vector<double> found =
        moments(build(other.view()), {.radius = std::ldexp(3.0, exponent)}, {.degree = 4, .weights = weights});
    for (unsigned i = 0; i <= 4; ++i) {
      const std::size_t column = moment_column(i, 4 - i, 0);
      for (std::size_t v = 0; v < mesh.size(); ++v) {
        ASSERT_EQ(std::ldexp(found[35 * v + column], 300 - 4 * exponent), expected[35 * v + column]);
      }
    }
  }
}

TEST(Moments, EigenvectorsOfASymmetricMatrixBelongToItsEigenvalues) {
  Random random(8);
  for (int round = 0; round < 500; ++round) {
    const auto number = [&] { return random.uniform(-1, 1) * std::pow(10.0, random.uniform(-6, 0)); };
    const Symmetric3 m{number(), number(), number(), number(), number(), number()};
    const Eigen3 found = eigen(m);
    const double size = std::max(std::abs(found.values[0]), std::abs(found.values[2]));
    EXPECT_LE(found.values[0], found.values[1]);
    EXPECT_LE(found.values[1], found.values[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point v = found.vectors[i];
      const Point image{m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
                        m.xz * v.x + m.yz * v.y + m.zz * v.z};
      EXPECT_LT(length(image - found.values[i] * v), 1e-14 * size);
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(v, found.vectors[j]), i == j ? 1 : 0, 1e-14);
    }
  }
}

TEST(PrincipalComponents, AreTheMeanAndTheCovarianceOfTheVertices) {
  Random random(2);
  const TestMesh mesh = bumpy_grid(15).finish(false);
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  const std::vector<double> weights = some_weights(random, mesh.size());
  const PrincipalComponents found = principal_components(index, {.radius = 2.5}, {.weights = weights});
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const Expected m = moments_of(mesh, oracle.exact(v, 2.5), v, weights);
    const long double weight = m.sums[0];
    EXPECT_NEAR(found.weight[v], static_cast<double>(weight), 1e-12);
    const Point center{found.center[3 * v], found.center[3 * v + 1], found.center[3 * v + 2]};
    EXPECT_NEAR(center.x, static_cast<double>(m.sums[1] / weight), 1e-12);
    EXPECT_NEAR(center.z, static_cast<double>(m.sums[3] / weight), 1e-12);
    const double xx = static_cast<double>(m.sums[4] / weight) - center.x * center.x;
    const double xz = static_cast<double>(m.sums[6] / weight) - center.x * center.z;
    double sum_xx = 0;
    double sum_xz = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double* const axis = &found.axes[9 * v + 3 * i];
      sum_xx += found.variances[3 * v + i] * axis[0] * axis[0];
      sum_xz += found.variances[3 * v + i] * axis[0] * axis[2];
    }
    EXPECT_NEAR(sum_xx, xx, 1e-12);
    EXPECT_NEAR(sum_xz, xz, 1e-12);
  }
}

TEST(PrincipalComponents, OfAPlaneHaveItsNormalAndItsArea) {
  const TestMesh mesh = make_grid(31, 31, true).finish(false);
  const std::vector<double> areas = vertex_areas(mesh.view());
  const std::vector<VertexId> rows{15 * 31 + 15};
  const PrincipalComponents found =
      principal_components(build(mesh.view()), {.vertices = rows, .radius = 10.0}, {.weights = areas});
  EXPECT_DOUBLE_EQ(found.weight[0], 317);  // lattice points in a disc of radius 10
  EXPECT_EQ(found.variances[0], 0);
  EXPECT_EQ(found.axes[2], 1);
  EXPECT_EQ(surface_variation(found.variances[0], found.variances[1], found.variances[2]), 0);
}

TEST(PrincipalComponents, OfNoWeightAreNan) {
  const TestMesh mesh = bumpy_grid(5).finish(false);
  const std::vector<double> weights(mesh.size(), 0.0);
  const PrincipalComponents found = principal_components(build(mesh.view()), {.radius = 2.0}, {.weights = weights});
  EXPECT_THAT(found.weight, testing::Each(0));
  EXPECT_THAT(found.center, testing::Each(testing::IsNan()));
  EXPECT_THAT(found.variances, testing::Each(testing::IsNan()));
  EXPECT_TRUE(std::isnan(surface_variation(0, 0, 0)));
  EXPECT_DOUBLE_EQ(surface_variation(1e300, 1e300, 1e300), 1.0 / 3);
}

TEST(Moments, RefuseInvalidArgumentsAndNameThem) {
  const auto [mesh, index] = indexed(bumpy_grid(5).finish(false));
  std::vector<double> weights(mesh.size(), 1.0);
  weights[7] = -2;
  const std::vector<VertexId> outside{25};
  expect_refused(ErrorCode::InvalidOption, "degree is 5",
                 [&] { return moments(index, {.radius = 1.0}, {.degree = 5}); });
  expect_refused(ErrorCode::InvalidOption, "weights: vertex 7 has -2",
                 [&] { return moments(index, {.radius = 1.0}, {.weights = weights}); });
  expect_refused(ErrorCode::InvalidOption, "weights: 3 values", [&] {
    return principal_components(index, {.radius = 1.0}, {.weights = std::span(weights).first(3)});
  });
  expect_refused(ErrorCode::InvalidRadius, "-1", [&] { return moments(index, {.radius = -1.0}); });
  expect_refused(ErrorCode::VertexOutOfRange, "25",
                 [&] { return moments(index, {.vertices = outside, .radius = 1.0}); });
}

}  // namespace
}  // namespace meshhood::test
