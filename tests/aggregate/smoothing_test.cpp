// SPDX-License-Identifier: MIT
// The weights of smoothing are those of the formulas, and a width means what it says.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/aggregate.h"
#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

constexpr double kDeviationsOfAWidth = 2.3548200450309493;  // 2 sqrt(2 ln 2)

TEST(SmoothingRadius, IsWhereTheGaussianIsAThousandth) {
  EXPECT_NEAR(smoothing_radius(6), 6 * std::sqrt(std::log2(1000)) / 2, 1e-14);
  EXPECT_NEAR(std::exp(-4 * std::numbers::ln2 * std::pow(smoothing_radius(1), 2)), 1e-3, 1e-17);
  EXPECT_EQ(smoothing_radius(0), 0);
  EXPECT_EQ(smoothing_radius(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
  for (const double wrong : {-1.0, std::nan("")}) {
    expect_refused(ErrorCode::InvalidRadius, "fwhm", [&] { return smoothing_radius(wrong); });
  }
}

TEST(SmoothingWeight, OfAGaussianIsTheExponentialFunction) {
  double most = 0;
  for (int i = 0; i <= 100'000; ++i) {
    const double distance = 3e-5 * i;
    const long double share = static_cast<long double>(distance) / 3;
    const long double weight = std::exp(-std::log(1000.0L) * share * share);
    const long double found = smoothing_weight(SmoothingKernel::Gaussian, distance, 3);
    most = std::max(most, static_cast<double>(std::abs(found - weight) / weight));
  }
  std::printf("relative error of 100,001 weights: at most %.2g\n", most);
  EXPECT_LE(most, 1e-14);
}

// As `distance` says: a search compares squares, which are 0 here.
TEST(SmoothingWeight, OfAVertexThatCountsBeyondTheRadiusIsThatAtTheRadius) {
  const std::vector<double> positions{0, 0, 0, 0x1p-540, 0, 0};
  const std::vector<VertexId> face{0, 1, 1};
  const std::vector<double> values{0, 1};
  const Index index = build({PositionsView(positions), FacesView::triangles(face)});
  const double radius = 0x1p-541;
  EXPECT_EQ(Searcher(index).count(0, radius), 2U);
  for (const SmoothingKernel kernel : {SmoothingKernel::Biweight, SmoothingKernel::Gaussian}) {
    const double weight = smoothing_weight(kernel, radius, radius);
    EXPECT_NEAR(aggregate(index, {values}, {.radius = radius, .kernel = kernel})[0], weight / (1 + weight), 1e-14);
  }
}

TEST(SmoothingWeight, IsOneAtTheVertexAndEndsAtTheRadius) {
  using enum SmoothingKernel;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const SmoothingKernel kernel : {Box, Epanechnikov, Biweight, Gaussian}) {
    EXPECT_EQ(smoothing_weight(kernel, 0, 0), 1);
    EXPECT_EQ(smoothing_weight(kernel, 0, 2), 1);
    EXPECT_EQ(smoothing_weight(kernel, 5, kInfinite), 1);
    EXPECT_EQ(smoothing_weight(kernel, std::nextafter(2.0, 3.0), 2), 0);
  }
  EXPECT_EQ(smoothing_weight(Box, 2, 2), 1);
  EXPECT_EQ(smoothing_weight(Epanechnikov, 2, 2), 0);
  EXPECT_EQ(smoothing_weight(Biweight, 2, 2), 0);
  EXPECT_NEAR(smoothing_weight(Gaussian, 2, 2), 1e-3, 1e-17);
  EXPECT_EQ(smoothing_weight(Biweight, 1, 2), 0.5625);
}

/// The response to a value of 1 at the middle of a fine plane.
class SmoothedPoint : public testing::TestWithParam<Metric> {
 protected:
  static constexpr std::size_t kSide = 161;
  static constexpr double kWidth = 24;

  SmoothedPoint() : mesh(make_grid(kSide, kSide, false).finish(false)), values(mesh.size()) {
    values[kMiddle * kSide + kMiddle] = 1;
    smooth = aggregate(build(mesh.view()), {.values = values},
                       {.radius = smoothing_radius(kWidth), .metric = GetParam(), .kernel = SmoothingKernel::Gaussian});
  }

  /// By the distance along a line of the lattice, on which straight lines and paths are the same.
  [[nodiscard]] double along_line(std::size_t distance) const { return smooth[kMiddle * kSide + kMiddle + distance]; }

  static constexpr std::size_t kMiddle = kSide / 2;
  TestMesh mesh;
  std::vector<double> values;
  std::vector<double> smooth;
};

TEST_P(SmoothedPoint, HasTheWidthAtHalfHeight) {
  const double half = along_line(0) / 2;
  std::size_t after = 0;
  while (along_line(after) > half) ++after;
  const double step = (along_line(after - 1) - half) / (along_line(after - 1) - along_line(after));
  const double width = 2 * (static_cast<double>(after - 1) + step);
  std::printf("width at half height: %.4f of the width asked for\n", width / kWidth);
  EXPECT_NEAR(width, kWidth, 0.01 * kWidth);
}

// In a plane whose profile by the distance is this one, the variance along each axis is half the mean square distance.
TEST_P(SmoothedPoint, HasTheVarianceOfTheWidth) {
  double weights = 0;
  double squares = 0;
  for (std::size_t i = 1; kMiddle + i < kSide; ++i) {
    const auto distance = static_cast<double>(i);
    weights += along_line(i) * distance;
    squares += along_line(i) * distance * distance * distance;
  }
  const double width = kDeviationsOfAWidth * std::sqrt(squares / weights / 2);
  std::printf("width by the variance of the profile: %.4f of the width asked for\n", width / kWidth);
  EXPECT_NEAR(width, kWidth, 0.01 * kWidth);
}

TEST_P(SmoothedPoint, EndsWithAThousandthAtTheRadius) {
  const auto last = static_cast<std::size_t>(smoothing_radius(kWidth));
  EXPECT_GT(along_line(last), 0.00099 * along_line(0));
  EXPECT_EQ(along_line(last + 1), 0);
}

INSTANTIATE_TEST_SUITE_P(Metrics, SmoothedPoint, testing::Values(Metric::Straight, Metric::Path),
                         [](const auto& metric) { return metric.param == Metric::Path ? "Path" : "Straight"; });

}  // namespace
}  // namespace meshhood::test
