// SPDX-License-Identifier: MIT
#include "exact/build/kd_order.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

using Points = std::vector<KdPoint>;

/// With coordinates below `range`, and so with many ties.
Points random_points(Random& random, std::size_t count, std::size_t range) {
  Points points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return static_cast<float>(random.below(range)); };
    points.push_back({{coordinate(), coordinate(), coordinate()}, i});
  }
  return points;
}

Points shuffled(Random& random, const Points& points) {
  Points result;
  for (const std::uint32_t i : random.permutation(points.size())) result.push_back(points[i]);
  return result;
}

std::vector<std::uint32_t> ids(std::span<const KdPoint> points) {
  std::vector<std::uint32_t> result;
  for (const KdPoint& p : points) result.push_back(p.id);
  return result;
}

std::vector<std::uint32_t> sorted_ids(std::span<const KdPoint> points) {
  std::vector<std::uint32_t> result = ids(points);
  std::sort(result.begin(), result.end());
  return result;
}

void expect_same_units(std::span<const KdPoint> a, std::span<const KdPoint> b, std::size_t unit) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t begin = 0; begin < a.size(); begin += unit) {
    const std::size_t size = std::min(unit, a.size() - begin);
    ASSERT_EQ(sorted_ids(a.subspan(begin, size)), sorted_ids(b.subspan(begin, size))) << "from " << begin << " on";
  }
}

/// The definition, by sorting.
void order_by_sorting(std::span<KdPoint> points, std::size_t unit) {
  if (points.size() <= unit) return;
  std::size_t widest = 0;
  float width = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [&](const KdPoint& a, const KdPoint& b) { return a.at[axis] < b.at[axis]; });
    if (high->at[axis] - low->at[axis] > width) {
      width = high->at[axis] - low->at[axis];
      widest = axis;
    }
  }
  std::sort(points.begin(), points.end(), [&](const KdPoint& a, const KdPoint& b) {
    return std::tie(a.at[widest], a.id) < std::tie(b.at[widest], b.id);
  });
  const std::size_t middle = (points.size() + unit - 1) / unit / 2 * unit;
  order_by_sorting(points.first(middle), unit);
  order_by_sorting(points.subspan(middle), unit);
}

TEST(KdOrder, TheOrderWithinAUnitIsTheSameWithEveryStandardLibrary) {
  Random random(1);
  Points points = random_points(random, 30, 8);
  kd_order(points, 10);
  EXPECT_THAT(ids(points), ElementsAre(1, 0, 28, 27, 4, 15, 14, 5, 9, 16, 22, 17, 12, 6, 21, 10, 3, 23, 19, 24, 25, 29,
                                       2, 7, 8, 13, 26, 20, 18, 11));
}

TEST(KdOrder, CutsAcrossTheWidestSideAtAMultipleOfTheUnit) {
  Random random(1);
  for (const std::size_t count : {0U, 1U, 29U, 30U, 31U, 60U, 61U, 500U, 5000U}) {
    for (const std::size_t range : {1U, 2U, 50U, 1000000U}) {
      Points points = random_points(random, count, range);
      Points expected = points;
      order_by_sorting(expected, 30);
      kd_order(points, 30);
      expect_same_units(points, expected, 30);
    }
  }
}

TEST(KdOrder, UnitsDoNotDependOnTheOrderGiven) {
  Random random(2);
  Points points = random_points(random, 5000, 50);
  Points others = shuffled(random, points);
  kd_order(points, 30);
  kd_order(others, 30);
  expect_same_units(points, others, 30);
}

TEST(KdOrder, IsTheSameForAnyNumberOfThreads) {
  Random random(3);
  const Progress silent;
  for (const std::size_t count : {10U, 3000U, 40000U}) {
    const Points given = random_points(random, count, 1000);
    Points expected = given;
    kd_order(expected, 30);
    for (const unsigned threads : {1U, 2U, 5U}) {
      TaskContext task(threads, silent, 0);
      Points points = given;
      kd_order(points, 30, task);
      EXPECT_EQ(ids(points), ids(expected)) << threads << " threads";
    }
  }
}

TEST(KdOrder, PutsPointsOnALineInTheirOrder) {
  Random random(4);
  for (const std::size_t axis : {0U, 1U, 2U}) {
    Points points;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      points.push_back({{1, 2, 3}, i});
      points.back().at[axis] = static_cast<float>(i) - 500;
    }
    points = shuffled(random, points);
    kd_order(points, 1);
    EXPECT_TRUE(std::ranges::is_sorted(ids(points))) << "axis " << axis;
  }
}

TEST(KdOrder, OrdersCoincidentPointsByTheirIds) {
  Random random(5);
  Points points(1000, KdPoint{{0.1F, 0.2F, 0.3F}, 0});
  for (std::uint32_t i = 0; i < points.size(); ++i) points[i].id = i;
  points = shuffled(random, points);
  kd_order(points, 1);
  EXPECT_TRUE(std::ranges::is_sorted(ids(points)));
}

TEST(KdOrderNested, HoldsForEveryPowerOfTheFanOut) {
  Random random(6);
  for (const std::size_t count : {0U, 1U, 8U, 9U, 64U, 65U, 600U, 5000U}) {
    Points points = random_points(random, count, 100);
    Points expected = points;
    kd_order_nested(points, 8);
    // The largest power comes first, and each run is cut again by the next.
    std::size_t unit = 8;
    while (unit * 8 < count) unit *= 8;
    std::size_t run = std::max<std::size_t>(count, 1);
    for (; unit >= 8; run = unit, unit /= 8) {
      for (std::size_t begin = 0; begin < count; begin += run) {
        order_by_sorting(std::span(expected).subspan(begin, std::min(run, count - begin)), unit);
      }
      expect_same_units(points, expected, unit);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
