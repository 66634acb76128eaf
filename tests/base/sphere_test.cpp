// SPDX-License-Identifier: MIT
// Rows A15 and A16 of the catalogue in docs/reliability.md.
#include "base/sphere.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Points = std::vector<double>;  // #points by 3

/// Whether every point is inside as distances are computed in double, and nearly inside in long double.
template <class Real>
bool encloses(const Sphere<Real>& sphere, const std::vector<Real>& xyz) {
  const Point center{static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)};
  const auto radius = static_cast<double>(sphere.radius);
  for (std::size_t i = 0; i < xyz.size() / 3; ++i) {
    const Point p = point(std::span<const Real>(xyz), i);
    if (!(std::sqrt(squared_distance(center, p)) <= radius)) return false;
    const long double dx = static_cast<long double>(p.x) - center.x;
    const long double dy = static_cast<long double>(p.y) - center.y;
    const long double dz = static_cast<long double>(p.z) - center.z;
    if (std::sqrt(dx * dx + dy * dy + dz * dz) > radius * (1 + 1e-15L) + 1e-160L) return false;
  }
  return true;
}

template <class Real>
Sphere<Real> sphere_of(const std::vector<Real>& xyz) {
  const Sphere<Real> sphere = bounding_sphere(std::span<const Real>(xyz));
  EXPECT_TRUE(std::isfinite(sphere.radius));
  EXPECT_TRUE(encloses(sphere, xyz));
  return sphere;
}

/// Within a thousandth of `smallest` in double, and in float up to the rounding of the center.
void expect_tight(const Points& points, double smallest) {
  EXPECT_LE(sphere_of(points).radius, smallest * 1.001 * (1 + 1e-12));
  const std::vector<float> single(points.begin(), points.end());
  EXPECT_LE(static_cast<double>(sphere_of(single).radius), smallest * 1.001 * (1 + 1e-6));
}

void add(Points& points, double x, double y, double z) {
  points.push_back(x);
  points.push_back(y);
  points.push_back(z);
}

Points scaled_by(double factor, Points points) {
  for (double& x : points) x *= factor;
  return points;
}

Points regular_polygon(std::size_t n) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    add(points, std::cos(angle), std::sin(angle), 0);
  }
  return points;
}

Points random_points(Random& random, std::size_t count, double x, double y, double z) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    add(points, random.uniform(-x, x), random.uniform(-y, y), random.uniform(-z, z));
  }
  return points;
}

const Points kCube{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
const Points kTetrahedron{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
const Points kOctahedron{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};

Points icosahedron() {
  const double g = std::numbers::phi;
  Points points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      add(points, 0, a, b);
      add(points, a, b, 0);
      add(points, b, 0, a);
    }
  }
  return points;
}

TEST(BoundingSphere, OfCoincidentPointsHasRadiusZero) {
  for (const std::size_t copies : {1U, 2U, 3U, 4U, 1000U}) {
    std::vector<float> xyz(3 * copies, -7);
    for (std::size_t i = 0; i < copies; ++i) {
      xyz[3 * i] = 0.1F;
      xyz[3 * i + 2] = 1e20F;
    }
    const Sphere<float> sphere = sphere_of(xyz);
    EXPECT_EQ(sphere.radius, 0);
    EXPECT_EQ(sphere.x, 0.1F);
    EXPECT_EQ(sphere.z, 1e20F);
  }
}

TEST(BoundingSphere, IsTightAroundKnownSolids) {
  for (const double scale : {1.0, 0x1p-100, 0x1p90, 3.7, 1e30, 1e-30}) {
    expect_tight(scaled_by(scale, kCube), scale * std::numbers::sqrt3 / 2);
    expect_tight(scaled_by(scale, kTetrahedron), scale * std::numbers::sqrt3);
    expect_tight(scaled_by(scale, kOctahedron), scale);
    expect_tight(scaled_by(scale, icosahedron()), scale * std::hypot(1, std::numbers::phi));
    expect_tight(scaled_by(scale, {0, 0, 0, 2, 0, 0}), scale);
    expect_tight(scaled_by(scale, {0, 0, 0, 2, 0, 0, 1, 0.1, 0}), scale);  // obtuse: the ball of the longest side
  }
}

TEST(BoundingSphere, IsTightAroundCocircularPoints) {
  for (const std::size_t n : {3U, 4U, 5U, 6U, 7U, 12U, 17U, 1000U}) {
    SCOPED_TRACE(n);
    expect_tight(regular_polygon(n), 1);
  }
}

TEST(BoundingSphere, IsTightAroundCosphericalPoints) {
  Random random(1);
  Points points = kOctahedron;  // so that the unit sphere is the smallest
  for (int i = 0; i < 1000; ++i) {
    Points p = random_points(random, 1, 1, 1, 1);
    const double length = std::hypot(p[0], p[1], p[2]);
    for (const double x : p) points.push_back(x / length);
  }
  expect_tight(points, 1);
}

TEST(BoundingSphere, IsTightAroundCollinearPoints) {
  Random random(2);
  for (std::size_t i = 0; i < scaled(2000, 50); ++i) {
    Points points;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    const Points along = random_points(random, 1, 1, 1, 1);
    for (std::size_t k = 0; k < 2 + i % 50; ++k) {
      const double t = random.uniform(-1, 1);
      low = std::min(low, t);
      high = std::max(high, t);
      for (const double x : along) points.push_back(t * x);
    }
    const double half = (high - low) / 2 * std::hypot(along[0], along[1], along[2]);
    EXPECT_LE(sphere_of(points).radius, half * 1.001 * (1 + 1e-9));
  }
}

TEST(BoundingSphere, EnclosesNearlyFlatPoints) {
  Random random(3);
  std::size_t sets = 0;
  for (const double thin : {0.0, 1e-300, 1e-30, 1e-16, 1e-12, 1e-8, 1e-4}) {
    for (std::size_t i = 0; i < scaled(3000, 50); ++i, sets += 2) {
      const std::size_t count = 2 + random.below(12);
      const Points points = random_points(random, count, 1, i % 2 == 0 ? 1 : thin, thin);
      sphere_of(points);
      sphere_of(std::vector<float>(points.begin(), points.end()));
    }
  }
  std::printf("%zu sets of points\n", sets);
}

TEST(BoundingSphere, EnclosesPointsAtTheEndsOfTheRange) {
  Random random(4);
  std::size_t sets = 0;
  for (int exponent = -1074; exponent <= 500; ++exponent) {
    for (int i = 0; i < 5; ++i, ++sets) {
      const double size = std::ldexp(1.0, exponent);
      sphere_of(random_points(random, 1 + random.below(40), size, size, size));
    }
  }
  for (int exponent = -149; exponent <= 125; ++exponent) {
    for (int i = 0; i < 5; ++i, ++sets) {
      const double size = std::ldexp(1.0, exponent);
      const Points points = random_points(random, 1 + random.below(40), size, size, size);
      sphere_of(std::vector<float>(points.begin(), points.end()));
    }
  }
  std::printf("%zu sets of points\n", sets);
}

TEST(BoundingSphere, EnclosesFarFromTheOrigin) {
  Random random(5);
  for (const double offset : {1e3, 1e6, 1e9, 1e15, 1e30}) {
    for (int i = 0; i < 200; ++i) {
      Points points = random_points(random, 1 + random.below(40), 1, 1, 1);
      for (double& x : points) x += offset;
      sphere_of(points);
      sphere_of(std::vector<float>(points.begin(), points.end()));
    }
  }
}

TEST(BoundingSphere, IsTightFarFromTheOrigin) {
  Random random(7);
  for (const double offset : {1e3, 1e6, 1e9}) {
    SCOPED_TRACE(offset);
    for (int i = 0; i < 200; ++i) {
      Points points = random_points(random, 1 + random.below(40), 1, 1, 1);
      for (double& x : points) x += offset;
      Points near = points;
      for (double& x : near) x -= offset;  // exact
      EXPECT_LE(sphere_of(points).radius, sphere_of(near).radius * 1.001 * (1 + 1e-6));
    }
  }
}

TEST(BoundingSphere, EnclosesMixedScales) {
  Random random(6);
  for (std::size_t i = 0; i < scaled(5000, 100); ++i) {
    Points points = random_points(random, 1 + random.below(20), 1, 1, 1);
    for (double& x : points) x = std::ldexp(x, static_cast<int>(random.below(200)) - 100);
    sphere_of(points);
    sphere_of(std::vector<float>(points.begin(), points.end()));
  }
}

}  // namespace
}  // namespace meshhood::test
