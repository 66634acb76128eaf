// SPDX-License-Identifier: MIT
// The kernels of aggregates give the results of their definitions, with the same bits on every processor.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simd/aggregate.h"
#include "simd/gaussian.h"
#include "support/exact_answer.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

template <class T>
std::vector<std::uint64_t> bits_of(const T& doubles) {
  std::vector<std::uint64_t> bits(sizeof(T) / sizeof(std::uint64_t));
  std::memcpy(bits.data(), &doubles, sizeof(T));
  return bits;
}

class EveryAggregatePath : public testing::TestWithParam<Isa> {
 protected:
  double number() {
    if (random.below(50) == 0) return std::numeric_limits<double>::infinity();
    return random.uniform(-1, 1) * std::exp2(random.uniform(-60, 60));
  }

  template <std::size_t Size>
  void fill(std::array<double, Size>& numbers) {
    for (double& value : numbers) value = number();
  }

  /// Values with a word each, and totals so far.
  void draw() {
    values.resize(random.below(kLeafCapacity + 1));
    for (double& value : values) value = number();
    for (QueryWord& word : words) word = static_cast<QueryWord>(random.bits());
    fill(sums.high);
    fill(sums.low);
    fill(centers.x);
    fill(centers.y);
    fill(centers.z);
    for (double& unit : centers.unit) unit = std::exp2(static_cast<double>(random.below(20)) - 10);
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      const double square = random.uniform(1, 4);
      radii.square[row] = square;
      radii.low[row] = 0x1p-60 * random.uniform(-1, 1);
      radii.inverse[row] = 1 / square;
    }
  }

  const AggregateKernels& tried = aggregate_kernels(GetParam());
  const AggregateKernels& plain = aggregate_kernels(Isa{});
  Random random{21};
  std::vector<double> values;
  PerLane<QueryWord> words{};
  RowSums sums{};
  PacketCenters centers{};
  KernelRadii radii{};
};

TEST_P(EveryAggregatePath, GivesTheBitsOfTheFirstInstructionSet) {
  for (std::size_t round = 0; round < scaled(3000, 200); ++round) {
    draw();
    RowSums other = sums;
    tried.add_values(values, words.data(), sums);
    plain.add_values(values, words.data(), other);
    ASSERT_EQ(bits_of(sums), bits_of(other));

    PerLane<double> minima = sums.high;
    PerLane<double> other_minima = minima;
    tried.lower_minima(values, words.data(), minima);
    plain.lower_minima(values, words.data(), other_minima);
    ASSERT_EQ(bits_of(minima), bits_of(other_minima));

    PerLane<double> weights;
    std::array<PerLane<double>, 2> results;
    std::array<PerLane<double>, 2> others;
    fill(weights);
    tried.sum_deviations(values, weights.data(), words.data(), centers.x, results[0], results[1]);
    plain.sum_deviations(values, weights.data(), words.data(), centers.x, others[0], others[1]);
    ASSERT_EQ(bits_of(results), bits_of(others));

    RowSpreads spreads;
    RowSpreads added;
    for (PerLane<double>* const numbers : {&spreads.mean, &spreads.low, &spreads.squares}) fill(*numbers);
    for (PerLane<double>* const numbers : {&added.mean, &added.low, &added.squares}) fill(*numbers);
    for (double& weight : spreads.weight) weight = static_cast<double>(random.below(3));
    for (double& weight : added.weight) weight = static_cast<double>(random.below(3));
    RowSpreads other_spreads = spreads;
    tried.merge_spreads(added, spreads);
    plain.merge_spreads(added, other_spreads);
    ASSERT_EQ(bits_of(spreads), bits_of(other_spreads));
  }
}

TEST_P(EveryAggregatePath, GivesTheBitsOfTheFirstInstructionSetForWeightsByDistance) {
  for (std::size_t round = 0; round < scaled(3000, 200); ++round) {
    draw();
    const bool squared = random.below(2) == 0;
    Offsets offsets;
    Offsets other_offsets;
    RowWeights weights;
    RowWeights other_weights;
    for (std::size_t k = 0; k < kLeafCapacity; ++k) {
      const Point point{number(), number(), number()};
      tried.set_offsets(point, centers, offsets);
      plain.set_offsets(point, centers, other_offsets);
      ASSERT_EQ(bits_of(offsets), bits_of(other_offsets));
      tried.set_weights(offsets, radii, squared, weights[k]);
      plain.set_weights(other_offsets, radii, squared, other_weights[k]);
    }
    ASSERT_EQ(bits_of(weights), bits_of(other_weights));
    RowSums other = sums;
    tried.add_weighted(values, words.data(), weights, sums);
    plain.add_weighted(values, words.data(), weights, other);
    ASSERT_EQ(bits_of(sums), bits_of(other));

    Moments moments{number(), {number(), number(), number()}, number(), {}, {}, number()};
    fill(moments.second);
    fill(moments.third);
    tried.add_moments(moments, offsets, radii, squared, words[0], sums);
    plain.add_moments(moments, offsets, radii, squared, words[0], other);
    ASSERT_EQ(bits_of(sums), bits_of(other));
  }
}

TEST_P(EveryAggregatePath, GivesTheBitsOfOneNumberForGaussians) {
  for (std::size_t round = 0; round < scaled(3000, 200); ++round) {
    draw();
    std::vector<Point> points(random.below(kLeafCapacity + 1));
    const auto place = [&] { return Point{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
    std::ranges::generate(points, place);
    for (std::size_t row = 0; row < kPacketCapacity; ++row) {
      centers.set(row, place());
      centers.unit[row] = random.below(8) == 0 ? 0 : random.uniform(0.2, 1);
    }
    RowWeights weights;
    tried.set_gaussians(points, words.data(), centers, weights);
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (std::size_t row = 0; row < kPacketCapacity; ++row) {
        if ((words[k] >> row & 1U) == 0) continue;
        const double unit = centers.unit[row];
        const double x = (points[k].x - centers.x[row]) * unit;
        const double y = (points[k].y - centers.y[row]) * unit;
        const double z = (points[k].z - centers.z[row]) * unit;
        ASSERT_EQ(weights[k][row], gaussian(std::min(1.0, (x * x + y * y) + z * z)));
      }
    }
  }
}

TEST_P(EveryAggregatePath, AddsToTheRowsOfAWordAlone) {
  sums = {};
  const std::vector<double> two{3, std::numeric_limits<double>::quiet_NaN()};
  const PerLane<QueryWord> rows{0x80000005, 0x00010000};
  tried.add_values(two, rows.data(), sums);
  for (unsigned row = 0; row < kPacketCapacity; ++row) {
    if (row == 16) {
      EXPECT_TRUE(std::isnan(sums.high[row]));
    } else {
      EXPECT_EQ(sums.high[row], (0x80000005U >> row & 1U) != 0 ? 3 : 0);
    }
  }
}

TEST_P(EveryAggregatePath, KeepsTheRoundingErrorOfAnAddition) {
  sums = {};
  const PerLane<QueryWord> all{~QueryWord{0}};
  for (const double value : {1.0, 1e-20, 1e-20, -1.0}) tried.add_values(std::vector{value}, all.data(), sums);
  EXPECT_THAT(sums.high, testing::Each(0));
  EXPECT_THAT(sums.low, testing::Each(2e-20));
}

INSTANTIATE_TEST_SUITE_P(Isas, EveryAggregatePath, testing::ValuesIn(available_isas()));

}  // namespace
}  // namespace meshhood::test
