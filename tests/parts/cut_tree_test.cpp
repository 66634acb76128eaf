// SPDX-License-Identifier: MIT
#include "parts/cut_tree.h"

#include <cmath>
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

std::vector<std::uint32_t> parts_near(const CutTree& tree, const BoundingBox& box, double squared_halo) {
  std::vector<std::uint32_t> parts;
  tree.for_each_near(box, squared_halo, [&](std::uint32_t part, const BoundingBox&) { parts.push_back(part); });
  return parts;
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
  std::size_t ties = 0;
  for (const Site& a : sites) {
    for (const Site& b : sites) {
      // The radius is exactly the distance.
      const double squared = squared_radius(std::sqrt(squared_distance(a.position, b.position)));
      EXPECT_THAT(parts_near(tree, {a.position, a.position}, squared), testing::Contains(tree.owner(b)));
      ++ties;
    }
  }
  EXPECT_EQ(ties, 90000U);
}

TEST(CutTree, HasNoPartNearbyThatOwnsNothing) {
  CutTree tree({}, 4);
  const BoundingBox origin{{0, 0, 0}, {0, 0, 0}};
  EXPECT_THAT(parts_near(tree, origin, kInfinity), testing::IsEmpty());
  tree.add({{1, 1, 1}, 0});
  EXPECT_THAT(parts_near(tree, origin, squared_radius(std::numbers::sqrt3)), testing::SizeIs(1));
  EXPECT_THAT(parts_near(tree, origin, squared_radius(1.7)), testing::IsEmpty());
  EXPECT_THAT(parts_near(tree, {}, kInfinity), testing::IsEmpty()) << "nothing is near an empty box";
}

// The predicate is true of the nearest points of the boxes whenever it is true of any points of them.
TEST(BoundingBox, MayBeWithinEveryDistanceThatThePredicateAccepts) {
  Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const auto point = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    BoundingBox box;
    const Point inside = point();
    box.add(inside);
    box.add(point());
    const Point p = point();
    BoundingBox other{p, p};
    EXPECT_TRUE(parts::may_be_within(box, other, squared_distance(p, inside)));
    other.add(point());
    EXPECT_TRUE(parts::may_be_within(box, other, squared_distance(p, inside)));
    EXPECT_TRUE(parts::may_be_within(other, box, squared_distance(p, inside)));
  }
}

}  // namespace
}  // namespace meshhood::test
