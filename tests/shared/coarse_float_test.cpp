// SPDX-License-Identifier: MIT
#include "shared/coarse_float.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

// Where float is too coarse for the edges of a mesh.

namespace meshhood {
namespace {

/// A strip of triangles along the x axis, from `begin`: its edges across are `width` long, those along it grow from 0
/// to about twice `step`.
struct Strip {
  std::vector<double> xyz;
  std::vector<std::uint32_t> corners;

  Strip(double begin, double step, double width, std::uint32_t pairs) {
    for (std::uint32_t i = 0; i < pairs; ++i) {
      const double x = begin + step * i * i / pairs;
      for (const double y : {0.0, width}) xyz.insert(xyz.end(), {x, y, 0});
      const std::uint32_t v = 2 * i;
      if (i + 1 < pairs) corners.insert(corners.end(), {v, v + 2, v + 1, v + 1, v + 2, v + 3});
    }
  }

  [[nodiscard]] MeshView view() const { return {xyz, FacesView::triangles(corners)}; }

  /// Over the sides of all faces.
  [[nodiscard]] double mean() const {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t v = corners[i];
      const std::size_t w = corners[i % 3 == 2 ? i - 2 : i + 1];
      sum += std::hypot(xyz[3 * v] - xyz[3 * w], xyz[3 * v + 1] - xyz[3 * w + 1]);
    }
    return sum / static_cast<double>(corners.size());
  }
};

TEST(CoarseFloat, SaysTheMeanEdgeAndTheStepOfFloats) {
  const Strip strip(5'000'000, 0.125, 0.125, 100);
  const auto coarse = coarse_float(strip.view());
  ASSERT_TRUE(coarse);
  EXPECT_NEAR(coarse->mean_edge, strip.mean(), 1e-9);
  EXPECT_EQ(coarse->step, 0.5);
  EXPECT_EQ(coarse->largest, strip.xyz[strip.xyz.size() - 3]);
  EXPECT_EQ(coarse->text(), "the mean edge is 0.144, but floats are 0.5 apart at 5e+06");
}

// Whether few faces decide or all: the mean of all sides does.
TEST(CoarseFloat, IsDecidedByTheMeanOfAllSides) {
  std::mt19937 random(5);
  std::size_t coarse = 0;
  constexpr std::size_t kStrips = 300;
  for (std::size_t i = 0; i < kStrips; ++i) {
    const auto pairs = static_cast<std::uint32_t>(2 + random() % 3000);
    const double length = std::ldexp(static_cast<double>(1 + random() % 1000), -4);
    const double begin = random() % 2 == 0 ? 4'200'000 : -8'300'000;
    const Strip strip(begin, std::ldexp(length, -static_cast<int>(random() % 4)), length, pairs);
    double largest = 0;
    for (const double x : strip.xyz) largest = std::max(largest, std::abs(x));
    const bool expected = strip.mean() < 64 * std::ldexp(1.0, std::ilogb(largest) - 23);
    EXPECT_EQ(coarse_float(strip.view()).has_value(), expected);
    coarse += expected ? 1 : 0;
  }
  std::printf("coarse for %zu of %zu meshes\n", coarse, kStrips);
  EXPECT_GT(coarse, kStrips / 10);
  EXPECT_LT(coarse, kStrips - kStrips / 10);
}

TEST(CoarseFloat, NeedsAnEdgeThatHasALength) {
  const std::vector<float> far = {5e6F, 0, 0, 5e6F, 0, 0, 5e6F, 0, 1};
  const std::vector<float> equal = {5e6F, 0, 0, 5e6F, 0, 0, 5e6F, 0, 0};
  const std::vector<float> origin(9);
  const std::vector<std::uint32_t> triangle = {0, 1, 2};
  const std::vector<std::uint32_t> point = {1, 1, 1};
  EXPECT_TRUE(coarse_float({far, FacesView::triangles(triangle)}));
  EXPECT_FALSE(coarse_float({far, FacesView::triangles(point)}));
  EXPECT_FALSE(coarse_float({far, FacesView()}));
  EXPECT_FALSE(coarse_float({equal, FacesView::triangles(triangle)}));
  EXPECT_FALSE(coarse_float({origin, FacesView::triangles(triangle)}));
  EXPECT_FALSE(coarse_float(MeshView()));
}

}  // namespace
}  // namespace meshhood
