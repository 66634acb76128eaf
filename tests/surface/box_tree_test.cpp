// SPDX-License-Identifier: MIT
// The search of a tree of boxes, against a scan of all of them in long double.
#include "surface/box_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/vector.h"
#include "support/long_point.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

Long distance_of(const BoundingBox& box, const Point& p) {
  const auto gap = [](double low, double at, double high) {
    return std::max(
        {static_cast<Long>(low) - static_cast<Long>(at), static_cast<Long>(at) - static_cast<Long>(high), Long{0}});
  };
  const Long x = gap(box.low.x, p.x, box.high.x);
  const Long y = gap(box.low.y, p.y, box.high.y);
  const Long z = gap(box.low.z, p.z, box.high.z);
  return std::sqrt(x * x + y * y + z * z);
}

Point random_point(Random& random, double extent) {
  return {random.uniform(-extent, extent), random.uniform(-extent, extent), random.uniform(-extent, extent)};
}

class TreeOf : public testing::TestWithParam<std::size_t> {
 protected:
  TreeOf() {
    for (BoundingBox& box : boxes) {
      box.add(random_point(random, 1));
      const Point p = box.low;
      const double size = std::ldexp(1.0, -static_cast<int>(random.below(40)));
      box.add(Point{std::clamp(p.x + size, -1.0, 1.0), std::clamp(p.y + size, -1.0, 1.0), std::clamp(p.z, -1.0, 1.0)});
    }
    tree.build(boxes.size(), [&](std::size_t i) { return boxes[i]; });
  }

  Random random{GetParam()};
  std::vector<BoundingBox> boxes{GetParam()};
  BoxTree tree;
};

TEST_P(TreeOf, VisitsEveryBoxWithinReachOnce) {
  std::size_t skipped = 0;
  for (std::size_t round = 0; round < scaled(200, 40); ++round) {
    // Beside a box, where the rounding of the center matters, or far from all.
    const double size = std::ldexp(1.0, static_cast<int>(random.below(100)) - 50);
    const BoundingBox& beside = boxes[random.below(boxes.size())];
    const Point center = beside.high + random_point(random, size);
    const Long reach = distance_of(round % 2 == 0 ? beside : boxes[random.below(boxes.size())], center);  // a tie
    std::vector<int> visits(boxes.size(), 0);
    tree.search(center, [&] { return static_cast<double>(reach); }, [&](std::size_t i) { ++visits[i]; });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_LE(visits[i], 1);
      ASSERT_TRUE(visits[i] == 1 || distance_of(boxes[i], center) > reach) << i;
      skipped += static_cast<std::size_t>(visits[i] == 0);
    }
  }
  EXPECT_TRUE(skipped > 0 || boxes.size() == 1);
}

TEST_P(TreeOf, FindsTheNearestBoxByAShrinkingReach) {
  std::size_t visits = 0;
  const std::size_t rounds = scaled(200, 40);
  for (std::size_t round = 0; round < rounds; ++round) {
    const Point center = random_point(random, 2);
    Long expected = std::numeric_limits<Long>::infinity();
    for (const BoundingBox& box : boxes) expected = std::min(expected, distance_of(box, center));
    Long nearest = std::numeric_limits<Long>::infinity();
    tree.search(
        center, [&] { return static_cast<double>(nearest) * (1 + 1e-15); },
        [&](std::size_t i) {
          nearest = std::min(nearest, distance_of(boxes[i], center));
          ++visits;
        });
    ASSERT_EQ(nearest, expected);
  }
  EXPECT_LE(visits, rounds * (boxes.size() / 4 + 8));
}

/// Whether a ray meets a box up to `reach` times its direction.
bool meets(const Point& origin, const Point& direction, const BoundingBox& box, Long reach) {
  Long entry = 0;
  Long exit = reach;
  const auto cross_slab = [&](Long from, Long along, Long low, Long high) {
    if (along == 0) {
      if (from < low || from > high) exit = -1;
      return;
    }
    entry = std::max(entry, std::min((low - from) / along, (high - from) / along));
    exit = std::min(exit, std::max((low - from) / along, (high - from) / along));
  };
  cross_slab(origin.x, direction.x, box.low.x, box.high.x);
  cross_slab(origin.y, direction.y, box.low.y, box.high.y);
  cross_slab(origin.z, direction.z, box.low.z, box.high.z);
  return entry <= exit;
}

TEST_P(TreeOf, VisitsEveryBoxThatARayMeetsOnce) {
  std::size_t skipped = 0;
  for (std::size_t round = 0; round < scaled(200, 40); ++round) {
    const BoundingBox& target = boxes[random.below(boxes.size())];
    Point direction = random_point(random, 1);
    if (round % 3 == 0) direction.x = 0;
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    direction = {direction.x / largest, direction.y / largest, direction.z / largest};
    // Through a corner of a box, from inside or from far away.
    const Point origin = target.low - std::ldexp(random.uniform(), static_cast<int>(random.below(40)) - 20) * direction;
    const double reach = round % 4 == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 2);
    std::vector<int> visits(boxes.size(), 0);
    const auto reach_of_ray = [&] { return reach; };
    BoxTree::Line line(origin, direction, reach_of_ray);
    BoxTree::Walk walk(tree, line);
    while (walk.advance([&](std::size_t i) { ++visits[i]; }, [](std::size_t) {})) {
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_LE(visits[i], 1);
      ASSERT_TRUE(visits[i] == 1 || !meets(origin, direction, boxes[i], reach)) << i;
      skipped += static_cast<std::size_t>(visits[i] == 0);
    }
  }
  EXPECT_TRUE(skipped > 0 || boxes.size() == 1);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TreeOf, testing::Values(1, 2, 7, 8, 9, 64, 65, 600, 5000));

}  // namespace
}  // namespace meshhood::test
