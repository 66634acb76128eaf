// SPDX-License-Identifier: MIT
#include "exact/build/kd_order.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

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

void expect_cuts_as_by_sorting(Points points) {
  constexpr std::size_t kUnit = 30;
  Points expected = points;
  order_by_sorting(expected, kUnit);
  kd_order(points, kUnit);
  expect_same_units(points, expected, kUnit);
}

TEST(KdOrder, EachUnitAscendsByIds) {
  Random random(1);
  for (const std::size_t unit : {1U, 8U, 30U, 32U, 33U, 100U}) {
    Points points = random_points(random, 2000, 8);
    kd_order(points, unit);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % unit != 0) {
        ASSERT_LT(points[i - 1].id, points[i].id) << "unit " << unit;
      }
    }
  }
}

/// Points in clusters of very different size, so that most fall into one of the equal intervals of a cut.
Points uneven_points(Random& random, std::size_t count, float ratio) {
  Points points;
  for (std::uint32_t i = 0; i < count; ++i) {
    float scale = 1;
    for (std::size_t j = random.below(6); j > 0; --j) scale *= ratio;
    const auto coordinate = [&] { return scale * static_cast<float>(random.uniform()); };
    points.push_back({{coordinate(), coordinate(), coordinate()}, i});
  }
  return points;
}

TEST(KdOrder, CutsUnevenPointsAtTheSamePlace) {
  Random random(7);
  for (const float ratio : {0.5F, 1e-3F, 1e-6F, 1e-8F}) {
    for (const std::size_t count : {100U, 3000U, 20000U}) {
      expect_cuts_as_by_sorting(uneven_points(random, count, ratio));
    }
  }
}

TEST(KdOrder, CutsPointsAPartOfWhichHasOneCoordinate) {
  Random random(8);
  // One below or above all others, and a side so short that its reciprocal is not finite.
  for (const float other : {-1.0F, 2.0F, 1.0F + 0x1p-23F, 0x1p-149F}) {
    Points points(500, KdPoint{{other < 0x1p-100F ? 0.0F : 1.0F, 0, 0}, 0});
    for (std::uint32_t i = 0; i < points.size(); ++i) points[i].id = i;
    points[random.below(points.size())].at[0] = other;
    expect_cuts_as_by_sorting(shuffled(random, points));
  }
}

TEST(KdOrder, CutsAcrossTheWidestSideAtAMultipleOfTheUnit) {
  Random random(1);
  for (const std::size_t count : {0U, 1U, 29U, 30U, 31U, 60U, 61U, 500U, 5000U}) {
    for (const std::size_t range : {1U, 2U, 50U, 1000000U}) {
      expect_cuts_as_by_sorting(random_points(random, count, range));
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

}  // namespace
}  // namespace meshhood::test
