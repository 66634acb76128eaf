// SPDX-License-Identifier: MIT
// The bounds on distances and the filter of balls, on which region searches rely, agree with the predicate.
#include "exact/query/any_center.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/exact_answer.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class Bounds : public testing::TestWithParam<Family> {
 protected:
  /// Calls `f(view, center, random)` for centers near and far.
  template <class F>
  void for_each_center(F&& f) {
    for (const std::size_t vertices : {1U, 3U, 200U, 900U}) {
      const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(mesh.name);
      const Index index = build(mesh.view());
      Random random(vertices);
      for (std::size_t i = 0; i < scaled(30, 6); ++i) {
        const auto p = draw_start(random, mesh).plain.center;
        for (const double factor : {1.0, 1.0 + 0x1p-30, 7.0, 1e9, 1e40}) {
          const Point center{factor * p[0], p[1], factor * p[2]};
          if (std::max(std::abs(center.x), std::abs(center.z)) > kLargestCoordinate) continue;
          f(IndexAccess::view(index), center, random);
        }
      }
    }
  }
};

Point vertex(const IndexView& index, std::size_t v) {
  return std::visit([&](auto xyz) { return point(xyz, v); }, index.positions);
}

TEST_P(Bounds, OfALeafHoldTheDistancesOfItsVertices) {
  std::size_t tight = 0;
  std::size_t leaves = 0;
  for_each_center([&](const IndexView& index, const Point& p, Random&) {
    const Center center(index.frame, p);
    for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf, ++leaves) {
      const SquareRange range = squared_distances(index.leaves[leaf].bounds, center);
      tight += static_cast<std::size_t>(range.low > 0 && range.high <= 4 * range.low);
      for (std::size_t v = index.leaf_begin[leaf]; v < index.leaf_begin[leaf + 1]; ++v) {
        const double square = squared_distance(p, vertex(index, v));
        ASSERT_LE(range.low, square);
        ASSERT_GE(range.high, square);
      }
    }
  });
  std::printf("%zu leaves, %zu of them far away\n", leaves, tight);
}

TEST_P(Bounds, OfABallAnywhereGiveTheVerticesOfThePredicate) {
  std::size_t tests = 0;
  for_each_center([&](const IndexView& index, const Point& p, Random& random) {
    const Point tie = vertex(index, random.below(index.vertex_count()));
    for (const double radius : around(std::sqrt(squared_distance(p, tie)))) {
      const LeafBall ball = any_ball(p, radius);
      const auto leaf = static_cast<LeafId>(random.below(index.leaf_count()));
      const Leaf& record = index.leaves[leaf];
      LaneMask expected = 0;
      for (unsigned lane = 0; lane < record.size; ++lane) {
        const double distance = std::sqrt(squared_distance(p, index.position(leaf, lane)));
        expected |= LaneMask{distance <= radius} << lane;
      }
      for (const Isa isa : available_isas()) {
        ASSERT_EQ(kernels(isa).within(index.positions, record.first, record.size, ball), expected);
        ++tests;
      }
    }
  });
  std::printf("%zu leaves against balls\n", tests);
}

INSTANTIATE_TEST_SUITE_P(All, Bounds, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
