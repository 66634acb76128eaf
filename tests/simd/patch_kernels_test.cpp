// SPDX-License-Identifier: MIT
// What the kernels of patches leave out is not there, and they leave out most of it. Patches show what they measure.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>

#include <gtest/gtest.h>

#include "base/vector.h"
#include "patch/clipped_triangle.h"
#include "simd/patches.h"
#include "support/exact_answer.h"
#include "support/random.h"
#include "support/scale.h"
#include "surface/face_triangles.h"

namespace meshhood::test {
namespace {

/// A triangle and a ball, with what `ClippedTriangle` needs.
struct Cut {
  PatchTriangle triangle;
  PatchBall ball;
  std::size_t first;  // the corner that is alone inside or outside
};

class EveryPatchKernel : public testing::TestWithParam<Isa> {
 protected:
  EveryPatchKernel() {
    given_->corners.fill(triangles_[0].data());
    given_->balls.fill(balls_[0].data());
  }

  double coordinate(double size) { return size * random_.uniform(-1, 1); }
  Point point(double size) { return {coordinate(size), coordinate(size), coordinate(size)}; }

  /// Some triangles are slivers, have sides that nearly touch the ball, or corners far away.
  Cut draw() {
    for (;;) {
      const double size = std::exp2(random_.uniform(-6, 8));
      Cut cut{{{}, {}, {}}, patch_ball(point(3), std::exp2(random_.uniform(-3, 3)), 0.25), 0};
      const Point start = cut.ball.center + point(1.2 / cut.ball.unit);
      for (std::size_t i = 0; i < 3; ++i) {
        cut.triangle.corners[i] = start + point(size / cut.ball.unit);
        cut.triangle.places[i] = static_cast<std::uint32_t>(3 * random_.below(9) + i);
      }
      if (random_.below(8) == 0) cut.triangle.corners[2] = cut.triangle.corners[random_.below(2)] + point(1e-9);
      if (random_.below(30) == 0) cut.triangle.corners[2] = cut.triangle.corners[0];
      std::size_t inside = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        cut.triangle.inside[i] = cut.ball.contains(cut.triangle.corners[i]);
        inside += cut.triangle.inside[i] ? 1 : 0;
      }
      if (inside != 1 && inside != 2) continue;
      while (cut.triangle.inside[cut.first] != (inside == 1)) ++cut.first;
      return cut;
    }
  }

  /// Sets `cuts_` and what is given to the kernels. Returns how many there are.
  std::size_t draw_some() {
    const std::size_t count = 1 + random_.below(kPacketCapacity);
    for (std::size_t i = 0; i < count; ++i) set(i, cuts_[i] = draw());
    return count;
  }

  void set(std::size_t lane, const Cut& cut) {
    for (std::size_t i = 0; i < 5; ++i) triangles_[lane][i] = lane_row(cut.triangle.corners[i % 3]);
    balls_[lane][0] = lane_row(cut.ball.center, cut.ball.unit);
    given_->corners[lane] = &triangles_[lane][cut.first];
    given_->balls[lane] = balls_[lane].data();
    given_->insides[lane] = cut.triangle.inside[cut.first] ? 1 : -1;
  }

  Random random_{91};
  std::array<Cut, kPacketCapacity> cuts_;
  std::array<std::array<LaneRow, 5>, kPacketCapacity> triangles_{};
  std::array<std::array<LaneRow, 2>, kPacketCapacity> balls_{};
  std::unique_ptr<CutTriangles> given_ = std::make_unique<CutTriangles>();
};

TEST_P(EveryPatchKernel, FindsSidesThatMayDip) {
  std::size_t dips = 0;
  std::size_t others = 0;
  for (std::size_t round = 0; round < scaled(4000, 400); ++round) {
    const std::size_t count = draw_some();
    const LaneMask found = patch_kernels(GetParam()).may_dip(*given_, count);
    ASSERT_EQ(found & ~first_lanes(static_cast<unsigned>(count)), 0U);
    ASSERT_EQ(found, patch_kernels(Isa{}).may_dip(*given_, count));
    for (std::size_t i = 0; i < count; ++i) {
      const ClippedTriangle one(cuts_[i].ball, cuts_[i].triangle);
      const bool does = one.dips(0) || one.dips(1) || one.dips(2);
      dips += does ? 1 : 0;
      others += (found >> i & 1U) == 0 ? 1 : 0;
      ASSERT_TRUE(!does || (found >> i & 1U) != 0);
    }
  }
  std::printf("%zu sides dip, %zu triangles have none\n", dips, others);
  EXPECT_GT(dips, 0U);
  EXPECT_GT(others, dips);
}

TEST_P(EveryPatchKernel, LeavesOutTrianglesBeyondReach) {
  std::size_t near = 0;
  std::size_t left = 0;
  std::size_t others = 0;
  PointPerLane<double> centers{};
  PerLane<double> squared_reaches{};
  for (std::size_t round = 0; round < scaled(10000, 1000); ++round) {
    const Point start = point(2);
    const double size = std::exp2(random_.uniform(-12, 1));
    std::array corners{start + point(size), start + point(size), start + point(size)};
    if (random_.below(8) == 0) corners[2] = corners[random_.below(2)];
    std::array<double, kPacketCapacity> distances{};
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      centers.set(q, random_.below(20) == 0 ? corners[0] : point(2));
      distances[q] = nearest_in_triangle(centers.at(q), corners, 1).distance;
      const double reach = reach_of(distances[q] * (random_.below(2) == 0 ? 1 : random_.uniform(0, 2)), 1);
      squared_reaches[q] = reach * reach;
    }
    const auto queries = static_cast<QueryWord>(random_.below(std::uint64_t{1} << 32));
    const QueryWord found = patch_kernels(GetParam()).may_reach(corners, queries, centers, squared_reaches);
    ASSERT_EQ(found, patch_kernels(Isa{}).may_reach(corners, queries, centers, squared_reaches));
    ASSERT_EQ(found & ~queries, 0U);
    for_each_query(queries, [&](std::size_t q) {
      const bool reaches = distances[q] <= std::sqrt(squared_reaches[q]);
      const bool may = (found >> q & 1U) != 0;
      EXPECT_TRUE(may || !reaches) << distances[q];
      ++(reaches ? near : may ? others : left);
    });
  }
  std::printf("%zu triangles in reach, %zu left out, %zu not\n", near, left, others);
  EXPECT_GT(left, 10 * others);
}

INSTANTIATE_TEST_SUITE_P(Isas, EveryPatchKernel, testing::ValuesIn(available_isas()));

}  // namespace
}  // namespace meshhood::test
