// SPDX-License-Identifier: MIT
#include "base/triangulate.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/vector.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

using Flat = std::array<double, 2>;

/// Twice the signed area in the plane.
double doubled_area(const std::vector<Flat>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& [x, y] = polygon[i];
    const auto& [u, v] = polygon[(i + 1) % polygon.size()];
    sum += x * v - u * y;
  }
  return sum;
}

/// Expects triangles that have the orientation and together the area of the polygon, seen from several sides and
/// listed from each corner. So none overlap, and none is outside.
void expect_covered(const std::vector<Flat>& polygon) {
  const std::array<std::array<Point, 2>, 4> planes{{{{{1, 0, 0}, {0, 1, 0}}},
                                                    {{{0, 1, 0}, {0, 0, 1}}},
                                                    {{{0, 0, 1}, {1, 0, 0}}},
                                                    {{{0.6, 0.8, 0}, {0.48, -0.36, 0.8}}}}};
  for (const auto& [u, v] : planes) {
    for (const bool is_reversed : {false, true}) {
      for (std::size_t first = 0; first < polygon.size(); ++first) {
        std::vector<Point> corners;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const std::size_t k = is_reversed ? polygon.size() - i : i;
          const auto& [x, y] = polygon[(first + k) % polygon.size()];
          corners.push_back(x * u + y * v);
        }
        const Point whole = doubled_vector_area(corners.size(), [&](std::size_t i) { return corners[i]; });
        Triangulation triangles;
        triangulate(corners, triangles);
        ASSERT_EQ(triangles.size(), polygon.size() - 2);
        double area = 0;
        for (const auto& [a, b, c] : triangles) {
          const Point part = doubled_vector_area(corners[a], corners[b], corners[c]);
          EXPECT_GE(dot(part, whole), -1e-12 * dot(whole, whole));
          area += length(part);
        }
        EXPECT_NEAR(area, std::abs(doubled_area(polygon)), 1e-12 * area) << "from corner " << first;
      }
    }
  }
}

TEST(Triangulate, CoversPolygons) {
  expect_covered({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  expect_covered({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});                  // an L
  expect_covered({{0, 0}, {4, 1}, {0, 2}, {1, 1}});                                  // an arrow
  expect_covered({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {0, 1}});  // straight corners
  expect_covered({{0, 0}, {7, 0}, {7, 3}, {6, 1}, {5, 3}, {4, 1}, {3, 3}, {2, 1}, {1, 3}});
  // A square with a square hole, joined by a bridge whose ends are listed twice.
  expect_covered({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}});
}

/// A reflex corner that is listed again stays reflex, though the polygon turns at neither copy.
TEST(Triangulate, CoversPolygonsWithCornersThatAreListedAgain) {
  expect_covered({{4, 0}, {1, 1}, {1, 1}, {0, 4}, {0, 0}});                                  // an arrow
  expect_covered({{0, 0}, {2, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 2}, {0, 2}});  // an L
  expect_covered({{0, 0}, {0, 0}, {4, 1}, {4, 1}, {0, 2}, {0, 2}, {1, 1}, {1, 1}});
  expect_covered({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}});  // a square
}

TEST(Triangulate, CoversStars) {
  Random random(1);
  for (std::size_t trial = 0; trial < 30; ++trial) {
    std::vector<Flat> star;
    const std::size_t size = 4 + random.below(30);
    for (std::size_t i = 0; i < size; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(size);
      const double reach = random.uniform(0.1, 1);
      star.push_back({reach * std::cos(angle), reach * std::sin(angle)});
    }
    SCOPED_TRACE(trial);
    expect_covered(star);
  }
}

TEST(Triangulate, ConvexPolygonsAreFans) {
  const std::vector<Point> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0.5, 1.5, 0}, {0, 1, 0}};
  Triangulation triangles{{7, 7, 7}};
  triangulate(corners, triangles);
  EXPECT_THAT(triangles, testing::ElementsAre(std::array{0U, 1U, 2U}, std::array{0U, 2U, 3U}, std::array{0U, 3U, 4U}));
  triangulate(std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}, triangles);
  EXPECT_THAT(triangles, testing::ElementsAre(std::array{0U, 1U, 2U}, std::array{0U, 2U, 3U}, std::array{0U, 3U, 4U}));
  triangulate(std::span(corners).first(2), triangles);
  EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, PolygonsThatCrossThemselvesGiveTriangles) {
  Random random(2);
  for (std::size_t trial = 0; trial < 100; ++trial) {
    std::vector<Point> corners(3 + random.below(20));
    for (Point& p : corners) p = {random.uniform(), random.uniform(), random.uniform()};
    if (trial % 4 == 0) corners.assign(corners.size(), {1, 2, 3});
    Triangulation triangles;
    triangulate(corners, triangles);
    EXPECT_EQ(triangles.size(), corners.size() - 2);
    for (const auto& triangle : triangles) EXPECT_THAT(triangle, testing::Each(testing::Lt(corners.size())));
  }
}

}  // namespace
}  // namespace meshhood::test
