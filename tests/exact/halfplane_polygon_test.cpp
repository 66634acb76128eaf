// SPDX-License-Identifier: MIT
// The extent of a polygon of half planes, compared with the corners of all pairs of lines.
#include "exact/build/halfplane_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

struct Point2 {
  double x;
  double y;
};

double side(const Halfplane& h, double height) { return h.offset - height * h.tilt; }

bool holds(const std::vector<Halfplane>& halfplanes, const Point2& p, double height) {
  return std::all_of(halfplanes.begin(), halfplanes.end(), [&](const Halfplane& h) {
    return p.x * h.x + p.y * h.y <= side(h, height) + 1e-9 * std::hypot(h.x, h.y);
  });
}

/// The corners of the polygon at a height: the points where two lines meet and that lie in all half planes.
std::vector<Point2> corners(const std::vector<Halfplane>& halfplanes, double height) {
  std::vector<Point2> result;
  for (const Halfplane& a : halfplanes) {
    for (const Halfplane& b : halfplanes) {
      const double determinant = a.x * b.y - a.y * b.x;
      if (!(determinant > 0)) continue;
      const Point2 p{(side(a, height) * b.y - side(b, height) * a.y) / determinant,
                     (side(b, height) * a.x - side(a, height) * b.x) / determinant};
      if (holds(halfplanes, p, height)) result.push_back(p);
    }
  }
  return result;
}

double farthest(const std::vector<Point2>& points) {
  double result = 0;
  for (const Point2& p : points) result = std::max(result, std::hypot(p.x, p.y));
  return result;
}

HalfplanePolygon polygon_of(const std::vector<Halfplane>& halfplanes) {
  HalfplanePolygon polygon;
  for (const Halfplane& halfplane : halfplanes) polygon.add(halfplane, std::sqrt(2 * halfplane.offset));
  return polygon;
}

PolygonExtent extent_of(const std::vector<Halfplane>& halfplanes) { return polygon_of(halfplanes).extent(); }

bool is_bounded(const PolygonExtent& extent) { return std::isfinite(extent.width) && std::isfinite(extent.slope); }

/// As for an edge with the in-plane part (x, y) and the height `tilt`.
Halfplane of_edge(double x, double y, double tilt) { return {x, y, tilt, (x * x + y * y + tilt * tilt) / 2}; }

Halfplane at_angle(double turns, double length, double tilt = 0) {
  return of_edge(length * std::cos(2 * std::numbers::pi * turns), length * std::sin(2 * std::numbers::pi * turns),
                 tilt);
}

/// Half planes of random edges whose normals leave no gap of half a turn.
std::vector<Halfplane> random_edges(Random& random, std::size_t count) {
  std::vector<Halfplane> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = (static_cast<double>(i) + random.uniform(-0.4, 0.4)) / static_cast<double>(count);
    result.push_back(at_angle(turns, random.uniform(0.3, 1.5), random.uniform(-0.5, 0.5)));
  }
  for (std::size_t i = result.size(); i > 1; --i) std::swap(result[i - 1], result[random.below(i)]);
  return result;
}

TEST(DiamondAngle, GrowsWithTheAngle) {
  double last = -1;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    const double diamond = diamond_angle(std::cos(angle), std::sin(angle));
    EXPECT_GT(diamond, last);
    EXPECT_NEAR(diamond, i / 250.0, 0.1);
    last = diamond;
  }
  EXPECT_LT(last, 4);
}

TEST(HalfplanePolygon, WidthIsTheDistanceOfTheFarthestCorner) {
  Random random(1);
  const std::size_t polygons = scaled(5000, 500);
  for (std::size_t i = 0; i < polygons; ++i) {
    const std::vector<Halfplane> halfplanes = random_edges(random, 4 + i % 21);
    const PolygonExtent extent = extent_of(halfplanes);
    ASSERT_TRUE(is_bounded(extent));
    const double width = farthest(corners(halfplanes, 0));
    ASSERT_NEAR(extent.width, width, 1e-6 * width);
  }
  std::printf("%zu polygons\n", polygons);
}

TEST(HalfplanePolygon, NoCornerLiesFartherThanWidthPlusSlopeTimesHeight) {
  Random random(2);
  std::size_t found = 0;
  std::size_t larger = 0;
  for (std::size_t i = 0; i < scaled(2000, 200); ++i) {
    const std::vector<Halfplane> halfplanes = random_edges(random, 4 + i % 21);
    HalfplanePolygon polygon = polygon_of(halfplanes);
    const PolygonExtent rough = polygon.rough_extent();
    const PolygonExtent extent = polygon.extent();
    larger += static_cast<std::size_t>(rough.width > extent.width);
    for (const double height : {-10.0, -1.0, -0.1, 0.0, 0.1, 1.0, 10.0}) {
      const std::vector<Point2> at_height = corners(halfplanes, height);
      const double reach = farthest(at_height);
      ASSERT_LE(reach, (extent.width + extent.slope * std::abs(height)) * (1 + 1e-6)) << height;
      ASSERT_LE(reach, (rough.width + rough.slope * std::abs(height)) * (1 + 1e-6)) << height;
      found += at_height.size();
    }
  }
  std::printf("%zu corners\n", found);
  EXPECT_GT(found, 0U);
  EXPECT_GT(larger, 0U);
}

TEST(HalfplanePolygon, SlopeIsThatOfThePlaneThroughTheNeighbors) {
  // All neighbors lie in the plane with height 0.3 x, whose slope is 0.3.
  std::vector<Halfplane> halfplanes;
  for (const double turns : {0.05, 0.2, 0.4, 0.6, 0.75, 0.9}) {
    const Halfplane flat = at_angle(turns, 1);
    halfplanes.push_back(of_edge(flat.x, flat.y, 0.3 * flat.x));
  }
  EXPECT_NEAR(extent_of(halfplanes).slope, 0.3, 1e-12);
}

TEST(HalfplanePolygon, SquareReachesToItsCorners) {
  // Every corner of an axis-aligned grid is the corner of four lines at once.
  std::vector<Halfplane> halfplanes{of_edge(1, 0, 0), of_edge(0, 1, 0), of_edge(-1, 0, 0), of_edge(0, -1, 0)};
  EXPECT_DOUBLE_EQ(extent_of(halfplanes).width, std::numbers::sqrt2 / 2);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) halfplanes.push_back(of_edge(x, y, 0));
  }
  EXPECT_DOUBLE_EQ(extent_of(halfplanes).width, std::numbers::sqrt2 / 2);
  EXPECT_EQ(extent_of(halfplanes).slope, 0);
}

TEST(HalfplanePolygon, IsUnboundedWithoutThreeLinesAroundTheOrigin) {
  EXPECT_FALSE(is_bounded(extent_of({})));
  EXPECT_FALSE(is_bounded(extent_of({at_angle(0, 1)})));
  EXPECT_FALSE(is_bounded(extent_of({at_angle(0, 1), at_angle(0.4, 1)})));
  EXPECT_FALSE(is_bounded(extent_of({at_angle(0, 1), at_angle(0.2, 1), at_angle(0.4, 1)})));
  EXPECT_FALSE(is_bounded(extent_of({at_angle(0, 1), at_angle(0.25, 1), at_angle(0.5, 1)})));
  EXPECT_TRUE(is_bounded(extent_of({at_angle(0, 1), at_angle(0.3, 1), at_angle(0.6, 1)})));
}

TEST(HalfplanePolygon, IsUnboundedForAnyGapOfHalfATurn) {
  for (int i = 0; i < 64; ++i) {
    std::vector<Halfplane> halfplanes;
    for (int k = 0; k < 8; ++k) halfplanes.push_back(at_angle(i / 64.0 + k / 16.0, 1));
    EXPECT_FALSE(is_bounded(extent_of(halfplanes))) << i;
    halfplanes.push_back(at_angle(i / 64.0 + 0.75, 1));
    EXPECT_TRUE(is_bounded(extent_of(halfplanes))) << i;
  }
}

TEST(HalfplanePolygon, EdgesOfNoLengthOrOneDirectionDoNotBoundIt) {
  EXPECT_FALSE(is_bounded(extent_of({{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}})));
  EXPECT_FALSE(is_bounded(extent_of({at_angle(0.1, 1), at_angle(0.1, 2), at_angle(0.6, 1), at_angle(0.6, 2)})));
  // Neighbors straight above, with no part in the plane.
  EXPECT_FALSE(is_bounded(extent_of({of_edge(0, 0, 1), of_edge(0, 0, 2), of_edge(0, 0, -1)})));
}

TEST(HalfplanePolygon, LinesThatAreNearlyParallelMakeNoCorner) {
  const auto wedge = [](double turns) {
    return extent_of({at_angle(0, 1), at_angle(0.5 - turns, 1), at_angle(0.75, 1)});
  };
  EXPECT_TRUE(is_bounded(wedge(1e-3)));
  EXPECT_FALSE(is_bounded(wedge(1e-9)));
}

TEST(HalfplanePolygon, MoreLinesThanItHoldsMakeItNoSmallerThanItIs) {
  Random random(3);
  const std::vector<Halfplane> halfplanes = random_edges(random, 100);
  EXPECT_GE(extent_of(halfplanes).width, farthest(corners(halfplanes, 0)) * (1 - 1e-6));
}

TEST(HalfplanePolygon, DoesNotDependOnTheOrderOfItsLines) {
  Random random(4);
  for (std::size_t i = 0; i < scaled(2000, 100); ++i) {
    std::vector<Halfplane> halfplanes = random_edges(random, 4 + i % 20);
    const PolygonExtent expected = extent_of(halfplanes);
    std::reverse(halfplanes.begin(), halfplanes.end());
    EXPECT_NEAR(extent_of(halfplanes).width, expected.width, 1e-9 * expected.width);
  }
}

}  // namespace
}  // namespace meshhood::test
