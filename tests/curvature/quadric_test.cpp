// SPDX-License-Identifier: MIT
// The fit of a quadric and its curvatures, compared with formulas.
#include "curvature/quadric.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "base/vector.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

constexpr TangentFrame kFrame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Quadric random_quadric(Random& random, double slope) {
  return {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-slope, slope),
          random.uniform(-slope, slope)};
}

/// The normal curvature of the surface z = quadric at the origin in the tangent direction `t`, by its implicit form
/// f = z - quadric: t^T H t / |grad f|.
double normal_curvature(const Quadric& q, const Point& t) {
  const auto [a, b, c, d, e] = q;
  const double second = 2 * (a * t.x * t.x + b * t.x * t.y + c * t.y * t.y);
  return -second / std::sqrt(1 + d * d + e * e);
}

double distance_of_lines(const Point& a, const Point& b) { return std::min(length(a - b), length(a + b)); }

TEST(Quadric, ExactCurvaturesAreTheExtremesOfTheNormalCurvature) {
  Random random(1);
  double worst = 0;
  for (int round = 0; round < 2000; ++round) {
    const Quadric q = random_quadric(random, 2);
    const PrincipalCurvature k = principal_curvature(q, kFrame, ShapeOperator::Exact);
    const double size = std::max(std::abs(k.k1), std::abs(k.k2));
    ASSERT_GE(k.k1, k.k2);
    EXPECT_NEAR(length(k.d1), 1, 1e-14);
    EXPECT_NEAR(dot(k.d1, k.d2), 0, 1e-13);
    const Point normal{-q[3], -q[4], 1};
    EXPECT_NEAR(dot(k.d1, normal), 0, 1e-13);
    EXPECT_NEAR(dot(k.d2, normal), 0, 1e-13);
    worst = std::max(
        {worst, std::abs(normal_curvature(q, k.d1) - k.k1) / size, std::abs(normal_curvature(q, k.d2) - k.k2) / size});
    // Euler: every other direction lies between them.
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.4 * i;
      const Point t = std::cos(angle) * k.d1 + std::sin(angle) * k.d2;
      EXPECT_NEAR(normal_curvature(q, t), k.k1 * std::pow(std::cos(angle), 2) + k.k2 * std::pow(std::sin(angle), 2),
                  1e-12 * size);
    }
  }
  std::printf("2000 quadrics with slopes up to 2: worst relative difference %.1e\n", worst);
  EXPECT_LT(worst, 1e-13);
}

TEST(Quadric, ExactCurvaturesDoNotDependOnTheAxes) {
  Random random(2);
  for (int round = 0; round < 500; ++round) {
    const Quadric q = random_quadric(random, 2);
    const auto [a, b, c, d, e] = q;
    const double angle = random.uniform(0, 6);
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    const Quadric turned{a * x * x + b * x * y + c * y * y, 2 * (c - a) * x * y + b * (x * x - y * y),
                         a * y * y - b * x * y + c * x * x, d * x + e * y, e * x - d * y};
    const TangentFrame frame{{x, y, 0}, {-y, x, 0}, {0, 0, 1}};
    const PrincipalCurvature one = principal_curvature(q, kFrame, ShapeOperator::Exact);
    const PrincipalCurvature other = principal_curvature(turned, frame, ShapeOperator::Exact);
    const double size = std::max(std::abs(one.k1), std::abs(one.k2));
    EXPECT_NEAR(one.k1, other.k1, 1e-13 * size);
    EXPECT_NEAR(one.k2, other.k2, 1e-13 * size);
    EXPECT_LT(distance_of_lines(one.d1, other.d1) * (one.k1 - one.k2), 1e-12 * size);
  }
}

TEST(Quadric, LibiglsOperatorIsAnotherWhereTheQuadricIsTilted) {
  Random random(3);
  double most = 0;
  for (int round = 0; round < 500; ++round) {
    Quadric q = random_quadric(random, 2);
    const PrincipalCurvature exact = principal_curvature(q, kFrame, ShapeOperator::Exact);
    const PrincipalCurvature libigl = principal_curvature(q, kFrame, ShapeOperator::Libigl);
    const double size = std::max(std::abs(exact.k1), std::abs(exact.k2));
    most = std::max(most, std::abs(exact.k1 - libigl.k1) / size);
    q[3] = q[4] = 0;
    const PrincipalCurvature flat = principal_curvature(q, kFrame, ShapeOperator::Exact);
    const PrincipalCurvature same = principal_curvature(q, kFrame, ShapeOperator::Libigl);
    EXPECT_NEAR(flat.k1, same.k1, 1e-14 * size + 1e-14);
    EXPECT_NEAR(flat.k2, same.k2, 1e-14 * size + 1e-14);
  }
  std::printf("libigl's operator is off by up to %.0f %%\n", 100 * most);
  EXPECT_GT(most, 0.5);
}

TEST(Quadric, AnUmbilicHasEqualCurvaturesAndOrthogonalDirections) {
  for (const double curvature : {0.0, 0.5, -3.0, 1e-200}) {
    const PrincipalCurvature k =
        principal_curvature({-curvature / 2, 0, -curvature / 2, 0, 0}, kFrame, ShapeOperator::Exact);
    EXPECT_EQ(k.k1, curvature);
    EXPECT_EQ(k.k2, curvature);
    EXPECT_EQ(dot(k.d1, k.d2), 0);
    EXPECT_EQ(length(k.d1), 1);
  }
}

TEST(Quadric, TheComponentOfLargestMagnitudeOfADirectionIsPositive) {
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    for (const ShapeOperator shape_operator : {ShapeOperator::Exact, ShapeOperator::Libigl}) {
      const PrincipalCurvature k = principal_curvature(random_quadric(random, 1), kFrame, shape_operator);
      for (const Point& d : {k.d1, k.d2}) {
        EXPECT_EQ(std::max({d.x, d.y, d.z}), std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
      }
    }
  }
}

std::vector<Point> points_on(Random& random, const Quadric& q, std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    points.push_back({x, y, q[0] * x * x + q[1] * x * y + q[2] * y * y + q[3] * x + q[4] * y});
  }
  return points;
}

TEST(Quadric, PointsOnAQuadricDetermineIt) {
  Random random(5);
  for (const std::size_t count : {5U, 6U, 7U, 50U, 1000U}) {
    const Quadric q = random_quadric(random, 2);
    const PointFit fit = fit_points(points_on(random, q, count));
    EXPECT_TRUE(fit.unique);
    for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(fit.quadric[i], q[i], 1e-10) << count << " points";
  }
}

TEST(Quadric, ThePointsOfALineHaveTheFitWithTheSmallestCoefficients) {
  std::vector<Point> points;
  for (int i = -4; i <= 4; ++i) points.push_back({0.25 * i, 0, 0.5 * i * i / 16.0});
  const PointFit fit = fit_points(points);
  EXPECT_FALSE(fit.unique);
  const Quadric expected{0.5, 0, 0, 0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(fit.quadric[i], expected[i], 1e-14);
  const PointFit none = fit_points(std::vector<Point>(6, Point{0, 0, 0}));
  EXPECT_FALSE(none.unique);
  for (const double coefficient : none.quadric) EXPECT_EQ(coefficient, 0);
}

TEST(Quadric, FramesAreOrthonormalAndTurnRight) {
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    Point n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    n = (1 / length(n)) * n;
    const Point offset{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (const TangentFrame& frame : {frame_of(n), frame_towards(n, offset), frame_towards(n, {0, 0, 0})}) {
      EXPECT_NEAR(length(frame.u), 1, 1e-15);
      EXPECT_NEAR(length(frame.v), 1, 1e-15);
      EXPECT_NEAR(dot(frame.u, frame.v), 0, 1e-14);
      EXPECT_NEAR(dot(cross(frame.u, frame.v), n), 1, 1e-14);
    }
    EXPECT_NEAR(dot(frame_towards(n, offset).v, offset), 0, 1e-13);
  }
}

}  // namespace
}  // namespace meshhood::test
