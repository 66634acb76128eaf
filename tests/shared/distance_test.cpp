// SPDX-License-Identifier: MIT
#include "shared/distance.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/scale.h"
#include "support/test_mesh.h"

namespace meshhood::test {
namespace {

/// The definition of `squared_radius`: its root is within the radius, and that of the next double is not.
void expect_largest(double radius) {
  const double threshold = squared_radius(radius);
  ASSERT_LE(std::sqrt(threshold), radius) << radius;
  if (threshold == std::numeric_limits<double>::max()) return;
  ASSERT_GT(std::sqrt(std::nextafter(threshold, kInfinity)), radius) << radius;
}

TEST(SquaredRadius, IsTheLargestDoubleWhoseRootIsWithinTheRadius) {
  Random random(1);
  const std::size_t radii = scaled(1'000'000);
  for (std::size_t i = 0; i < radii; ++i) {
    expect_largest(random.uniform());
    expect_largest(std::ldexp(random.uniform(1, 2), static_cast<int>(random.below(1500)) - 1000));
  }
  std::printf("%zu radii\n", 2 * radii);
}

TEST(SquaredRadius, AVertexAtExactlyTheRadiusIsInside) {
  Random random(2);
  const std::size_t ties = scaled(1'000'000);
  std::size_t lost_by_squaring = 0;
  for (std::size_t i = 0; i < ties; ++i) {
    const double d2 = random.uniform(0, 3);
    const double radius = std::sqrt(d2);
    ASSERT_LE(d2, squared_radius(radius)) << d2;
    lost_by_squaring += static_cast<std::size_t>(d2 > radius * radius);
  }
  EXPECT_GT(lost_by_squaring, ties / 10) << "the ties are not the ones that matter";
  std::printf("%zu ties, of which the square of the radius would lose %zu\n", ties, lost_by_squaring);
}

TEST(SquaredRadius, HoldsAtTheEndsOfTheRange) {
  EXPECT_EQ(squared_radius(0), 0);
  EXPECT_EQ(squared_radius(-0.0), 0);
  EXPECT_EQ(squared_radius(kInfinity), kInfinity);
  EXPECT_EQ(squared_radius(1e200), kInfinity);
  EXPECT_EQ(squared_radius(std::numeric_limits<double>::max()), kInfinity);
  EXPECT_EQ(squared_radius(std::numeric_limits<double>::denorm_min()), 0);
  for (int exponent = -1074; exponent < 512; ++exponent) {
    const double power = std::ldexp(1.0, exponent);
    expect_largest(power);
    expect_largest(std::nextafter(power, 0.0));
    expect_largest(std::nextafter(power, kInfinity));
  }
}

TEST(SearchBall, ContainsAVertexAtExactlyItsRadius) {
  Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const Point p{random.uniform(), random.uniform(), random.uniform()};
    const Point q{random.uniform(), random.uniform(), random.uniform()};
    const double d = std::sqrt(squared_distance(p, q));
    ASSERT_TRUE(SearchBall(p, d).contains(q));
    ASSERT_FALSE(SearchBall(p, std::nextafter(d, 0.0)).contains(q));
  }
}

TEST(SearchBall, ContainsItsCenterAtRadiusZero) {
  EXPECT_TRUE(SearchBall({1, 2, 3}, 0).contains({1, 2, 3}));
  EXPECT_TRUE(SearchBall({1, 2, 3}, -0.0).contains({1, 2, 3}));
  EXPECT_FALSE(SearchBall({1, 2, 3}, 0).contains({1, 2, std::nextafter(3.0, 4.0)}));
}

TEST(SearchBall, ContainsAllAtInfinity) {
  const SearchBall ball({0x1p500, -0x1p500, 0x1p500}, kInfinity);
  EXPECT_TRUE(ball.contains({-0x1p500, 0x1p500, -0x1p500}));
  EXPECT_EQ(ball.classify(Sphere<double>{-0x1p500, 0x1p500, -0x1p500, 0x1p500}), Containment::Inside);
}

TEST(SearchBall, SpheresInsideOutsideAndIntersectingAreClassified) {
  const SearchBall ball({0, 0, 0}, 10);
  EXPECT_EQ(ball.classify(Sphere<float>{0, 0, 0, 1}), Containment::Inside);
  EXPECT_EQ(ball.classify(Sphere<float>{8, 0, 0, 1}), Containment::Inside);
  EXPECT_EQ(ball.classify(Sphere<float>{10, 0, 0, 1}), Containment::Intersecting);
  EXPECT_EQ(ball.classify(Sphere<float>{0, 0, 0, 11}), Containment::Intersecting);
  EXPECT_EQ(ball.classify(Sphere<float>{12, 0, 0, 1}), Containment::Outside);
}

/// `value` moved by about `steps` doubles.
double moved(double value, int steps) {
  if (std::abs(steps) > 3) return value * (1 + steps * 0x1p-52);
  for (; steps > 0; --steps) value = std::nextafter(value, kInfinity);
  for (; steps < 0 && value > 0; ++steps) value = std::nextafter(value, 0.0);
  return value;
}

/// A sphere around the given points, tight under the arithmetic of the query.
template <class Real>
Sphere<Real> around(const Point& center, const std::vector<Point>& points) {
  Sphere<Real> sphere{static_cast<Real>(center.x), static_cast<Real>(center.y), static_cast<Real>(center.z), 0};
  for (const Point& p : points) {
    const double d = std::sqrt(squared_distance(
        {static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)}, p));
    auto radius = static_cast<Real>(d);
    if (static_cast<double>(radius) < d) radius = std::nextafter(radius, std::numeric_limits<Real>::infinity());
    sphere.radius = std::max(sphere.radius, radius);
  }
  return sphere;
}

/// The points of `center` plus and minus `extent` along the line from `origin`: where the sphere is nearest to the ball
/// and farthest from it; and along the axes.
std::vector<Point> extremes(const Point& origin, const Point& center, double extent) {
  const double d = std::sqrt(squared_distance(origin, center));
  const double scale = d > 0 ? extent / d : 0;
  const Point along{(center.x - origin.x) * scale, (center.y - origin.y) * scale, (center.z - origin.z) * scale};
  return {{center.x - along.x, center.y - along.y, center.z - along.z},
          {center.x + along.x, center.y + along.y, center.z + along.z},
          {center.x + extent, center.y, center.z},
          {center.x, center.y - extent, center.z}};
}

struct GroupContainment {
  std::array<std::size_t, 3> of{};
};

/// N3: a containment never contradicts the predicate, with radii as close as possible to where it changes.
template <class Real>
void expect_conservative(Random& random, double size, GroupContainment& seen) {
  const auto coordinate = [&] { return static_cast<double>(static_cast<Real>(random.uniform(-size, size))); };
  const Point origin{coordinate(), coordinate(), coordinate()};
  const Point center{coordinate(), coordinate(), coordinate()};
  const auto points = extremes(origin, center, size * random.uniform(0, 0.5));
  const Sphere<Real> sphere = around<Real>(center, points);
  const double d = std::sqrt(squared_distance(origin, center));
  const auto r = static_cast<double>(sphere.radius);
  for (const double decision : {std::abs(d - r), d + r, d, std::sqrt(squared_distance(origin, points[0])),
                                std::sqrt(squared_distance(origin, points[1]))}) {
    for (const int steps : {-1000, -100, -50, -48, -44, -40, -3, -2, -1, 0, 1, 2, 3, 40, 44, 48, 50, 100, 1000}) {
      const SearchBall ball(origin, moved(decision, steps));
      const Containment containment = ball.classify(sphere);
      ++seen.of[static_cast<std::size_t>(containment)];
      for (const Point& p : points) {
        const bool contained = ball.contains(p);
        ASSERT_FALSE(containment == Containment::Outside && contained);
        ASSERT_FALSE(containment == Containment::Inside && !contained);
      }
    }
  }
}

TEST(SearchBall, ClassificationNeverContradictsThePredicate) {
  Random random(4);
  GroupContainment seen;
  const std::size_t spheres = scaled(30'000);
  for (std::size_t i = 0; i < spheres; ++i) {
    // The squares of the smallest vanish, those of the largest nearly overflow.
    const double size = std::ldexp(1.0, static_cast<int>(random.below(1100)) - 600);
    expect_conservative<double>(random, size, seen);
    expect_conservative<float>(random, std::ldexp(1.0, static_cast<int>(random.below(250)) - 140), seen);
    expect_conservative<double>(random, 1, seen);
  }
  std::printf("%zu outside, %zu intersecting, %zu inside\n", seen.of[0], seen.of[1], seen.of[2]);
  for (const std::size_t count : seen.of) EXPECT_GT(count, spheres / 100);
}

}  // namespace
}  // namespace meshhood::test
