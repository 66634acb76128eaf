// SPDX-License-Identifier: MIT
#include "parts/cut_tree.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

using parts::CutTree;
using parts::Site;

std::vector<Site> random_sites(std::size_t count, Random& random) {
  std::vector<Site> sites;
  for (std::uint64_t id = 0; id < count; ++id) {
    const auto coordinate = [&] { return std::floor(random.uniform(0, 20)) / 7; };  // many are equal
    sites.push_back({{coordinate(), coordinate(), coordinate()}, id});
  }
  return sites;
}

TEST(CutTree, GivesEveryPartTheSameShareOfTheSample) {
  Random random(1);
  const std::vector<Site> sites = random_sites(1000, random);
  for (const std::size_t parts : {1U, 2U, 3U, 7U, 32U, 100U}) {
    const CutTree tree(sites, parts);
    std::vector<double> owned(parts);
    for (const Site& site : sites) ++owned[tree.owner(site)];
    EXPECT_THAT(owned, testing::Each(testing::DoubleNear(1000.0 / static_cast<double>(parts), 8))) << parts;
  }
}

TEST(CutTree, FindsEveryPartThatOwnsAVertexWithinTheHalo) {
  Random random(2);
  const std::vector<Site> sites = random_sites(300, random);
  CutTree tree(sites, 9);
  for (const Site& site : sites) tree.add(site);
  std::vector<std::uint32_t> near;
  std::size_t ties = 0;
  for (const Site& a : sites) {
    for (const Site& b : sites) {
      // The radius is exactly the distance.
      const double radius = std::sqrt(squared_distance(a.position, b.position));
      tree.find_near(a.position, squared_radius(radius), near);
      EXPECT_THAT(near, testing::Contains(tree.owner(b)));
      ++ties;
    }
  }
  EXPECT_EQ(ties, 90000U);
}

TEST(CutTree, HasNoPartNearbyThatOwnsNothing) {
  CutTree tree({}, 4);
  std::vector<std::uint32_t> near;
  tree.find_near({0, 0, 0}, std::numeric_limits<double>::infinity(), near);
  EXPECT_THAT(near, testing::IsEmpty());
  tree.add({{1, 1, 1}, 0});
  tree.find_near({0, 0, 0}, squared_radius(std::numbers::sqrt3), near);
  EXPECT_EQ(near.size(), 1U);
  tree.find_near({0, 0, 0}, squared_radius(1.7), near);
  EXPECT_THAT(near, testing::IsEmpty());
}

// The predicate is true of a corner of the box whenever it is true of a point inside.
TEST(BoundingBox, MayHoldEveryPointThatThePredicateAccepts) {
  Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const auto point = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    BoundingBox box;
    const Point inside = point();
    box.add(inside);
    box.add(point());
    const Point p = point();
    EXPECT_TRUE(parts::may_hold_within(box, p, squared_distance(p, inside)));
  }
}

}  // namespace
}  // namespace meshhood::test
