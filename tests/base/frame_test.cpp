// SPDX-License-Identifier: MIT
#include "base/frame.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

template <class Real>
Frame frame_of(const std::vector<Real>& xyz) {
  return make_frame(PositionsView(std::span<const Real>(xyz)));
}

double largest(const Point& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

bool is_power_of_two(double x) {
  int exponent = 0;
  return std::frexp(x, &exponent) == 0.5;
}

std::vector<double> random_positions(Random& random, std::size_t count, double size, double offset) {
  std::vector<double> xyz(3 * count);
  for (double& x : xyz) x = offset + random.uniform(-size, size);
  return xyz;
}

TEST(Frame, EveryVertexLiesInTheUnitCubeAndFillsAtLeastHalfOfIt) {
  Random random(1);
  std::size_t meshes = 0;
  for (int exponent = -900; exponent <= 500; exponent += 7) {
    for (int i = 0; i < 20; ++i, ++meshes) {
      const double size = std::ldexp(random.uniform(1, 2), exponent);
      const std::vector<double> xyz = random_positions(random, 2 + random.below(50), size, i % 4 == 0 ? 3 * size : 0);
      const Frame frame = frame_of(xyz);
      ASSERT_TRUE(is_power_of_two(frame.scale)) << frame.scale;
      double extent = 0;
      for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
        extent = std::max(extent, largest(frame.to_frame(point(std::span<const double>(xyz), v))));
      }
      ASSERT_LE(extent, 1) << "exponent " << exponent;
      ASSERT_GE(extent, 0.5) << "exponent " << exponent;
    }
  }
  std::printf("%zu meshes\n", meshes);
}

TEST(Frame, ScalesLengthsWithoutRounding) {
  const std::vector<double> xyz{-3, 0, 0, 5, 1, 2};
  const Frame frame = frame_of(xyz);
  EXPECT_EQ(frame.origin.x, 1);
  EXPECT_EQ(frame.scale, 0.125);
  EXPECT_EQ(frame.to_frame({5, 1, 2}).x, 0.5);
}

TEST(Frame, RoundsAVertexByAtMostTwoToTheMinus25AlongEachAxis) {
  Random random(2);
  const std::vector<double> xyz = random_positions(random, 10000, 7, 100);
  const Frame frame = frame_of(xyz);
  double error = 0;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
    const Point p = point(std::span<const double>(xyz), v);
    const Point exact = frame.to_frame(p);
    const FramePoint rounded = frame.round(p);
    error = std::max(error, largest({exact.x - static_cast<double>(rounded.x), exact.y - static_cast<double>(rounded.y),
                                     exact.z - static_cast<double>(rounded.z)}));
  }
  EXPECT_LE(error, 0x1p-25);
  EXPECT_GT(error, 0);
}

TEST(Frame, WithoutExtentHasTheUnitOfThePositions) {
  EXPECT_EQ(frame_of(std::vector<float>{}).scale, 1);
  const Frame frame = frame_of(std::vector<float>{4, 5, 6, 4, 5, 6});
  EXPECT_EQ(frame.scale, 1);
  EXPECT_EQ(frame.to_frame({4, 5, 6}).x, 0);
}

TEST(Frame, AcceptsMeshesAtTheEndsOfTheRange) {
  // So small that no power of two within a double's exponents would make it large.
  const std::vector<double> tiny{0, 0, 0, 5e-324, 5e-324, 0};
  EXPECT_TRUE(std::isfinite(frame_of(tiny).scale));
  EXPECT_LE(largest(frame_of(tiny).to_frame({5e-324, 5e-324, 0})), 1);
  const std::vector<double> huge{-1e150, 0, 0, 1e150, 1e150, 0};
  EXPECT_LE(largest(frame_of(huge).to_frame({1e150, 1e150, 0})), 1);
}

}  // namespace
}  // namespace meshhood::test
