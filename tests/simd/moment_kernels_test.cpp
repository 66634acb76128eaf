// SPDX-License-Identifier: MIT
// The kernels of the moments compute the sums that they name, with the same bits for every instruction set.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simd/moments.h"
#include "support/exact_answer.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

struct Powers {
  std::size_t i;
  std::size_t j;
  std::size_t k;
};

std::vector<Powers> all_powers() {
  std::vector<Powers> powers;
  for (std::size_t i = 0; i <= 4; ++i) {
    for (std::size_t j = 0; i + j <= 4; ++j) {
      for (std::size_t k = 0; i + j + k <= 4; ++k) powers.push_back({i, j, k});
    }
  }
  return powers;
}

double power(double x, std::size_t n) {
  double result = 1;
  for (std::size_t i = 0; i < n; ++i) result *= x;
  return result;
}

struct Input {
  MomentPoints points{};
  std::vector<QueryWord> words;
};

Input random_input(Random& random, std::size_t size) {
  Input input;
  for (std::size_t i = 0; i < size; ++i) {
    input.points.x[i] = random.uniform(-1, 1);
    input.points.y[i] = random.uniform(-1, 1);
    input.points.z[i] = random.uniform(-1, 1);
    input.points.weight[i] = random.uniform(0, 2);
    input.words.push_back(static_cast<QueryWord>(random.below(std::uint64_t{1} << 32)));
  }
  return input;
}

QueryVectors random_vectors(Random& random) {
  QueryVectors vectors;
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    vectors.x[q] = random.uniform(-1, 1);
    vectors.y[q] = random.uniform(-1, 1);
    vectors.z[q] = random.uniform(-1, 1);
  }
  return vectors;
}

/// The sums of an input, without words and with them.
QueryMoments collected(const MomentKernels& kernels, const Input& common, const Input& some) {
  PartialMoments parts{};
  const auto by_word = std::make_unique<MomentsByWord>();
  QueryMoments out{};
  kernels.add_powers(common.points, common.words.size(), parts);
  kernels.add_powers_by_word(some.points, some.words, kPacketCapacity, *by_word);
  kernels.collect(parts, *by_word, out);
  return out;
}

double expected(const Input& common, const Input& some, std::size_t query, const Powers& n) {
  double sum = 0;
  const auto add = [&](const MomentPoints& p, std::size_t i) {
    sum += p.weight[i] * power(p.x[i], n.i) * power(p.y[i], n.j) * power(p.z[i], n.k);
  };
  for (std::size_t i = 0; i < common.words.size(); ++i) add(common.points, i);
  for (std::size_t i = 0; i < some.words.size(); ++i) {
    if ((some.words[i] >> query & 1U) != 0) add(some.points, i);
  }
  return sum;
}

TEST(MomentKernels, EachMomentHasAnIndexOfItsOwn) {
  std::vector<std::size_t> places;
  for (const Powers& n : all_powers()) places.push_back(moment_index(n.i, n.j, n.k));
  std::vector<std::size_t> ascending(kMomentCount);
  for (std::size_t i = 0; i < kMomentCount; ++i) ascending[i] = i;
  EXPECT_THAT(places, testing::UnorderedElementsAreArray(ascending));
  EXPECT_EQ(moment_index(0, 0, 0), 0U);
  EXPECT_EQ(moment_index(1, 0, 0), 15U);
  EXPECT_EQ(moment_index(0, 1, 0), 1U);
  EXPECT_EQ(moment_index(0, 0, 1), 2U);
}

TEST(MomentKernels, SumsAreThoseOfThePowersForEachQuery) {
  Random random(1);
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 63U, 64U}) {
    const Input common = random_input(random, size);
    const Input some = random_input(random, 64 - size);
    for (const Isa isa : available_isas()) {
      const QueryMoments sums = collected(moment_kernels(isa), common, some);
      for (const Powers& n : all_powers()) {
        for (std::size_t q = 0; q < kPacketCapacity; ++q) {
          EXPECT_NEAR(sums.at[moment_index(n.i, n.j, n.k)][q], expected(common, some, q, n), 1e-13);
        }
      }
    }
  }
}

TEST(MomentKernels, ShiftedMomentsAreThoseOfShiftedPoints) {
  Random random(2);
  const Input points = random_input(random, 40);
  const QueryVectors by = random_vectors(random);
  QueryMoments moments = collected(portable_moment_kernels(), points, {});
  portable_moment_kernels().shift(moments, by);
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    Input shifted = points;
    for (std::size_t i = 0; i < 40; ++i) {
      shifted.points.x[i] += by.x[q];
      shifted.points.y[i] += by.y[q];
      shifted.points.z[i] += by.z[q];
    }
    for (const Powers& n : all_powers()) {
      EXPECT_NEAR(moments.at[moment_index(n.i, n.j, n.k)][q], expected(shifted, {}, q, n), 1e-11);
    }
  }
}

TEST(MomentKernels, RotatedMomentsAreThoseOfRotatedPoints) {
  Random random(3);
  const Input points = random_input(random, 40);
  const QueryMoments moments = collected(portable_moment_kernels(), points, {});
  const QueryVectors u = random_vectors(random);
  const QueryVectors v = random_vectors(random);
  const QueryVectors n = random_vectors(random);
  FrameMoments out{};
  portable_moment_kernels().rotate(moments, u, v, n, out);
  struct Case {
    const QueryRow* row;
    Powers powers;
  };
  const std::vector<Case> cases{
      {&out.uu, {2, 0, 0}},  {&out.uv, {1, 1, 0}},   {&out.vv, {0, 2, 0}},  {&out.u4, {4, 0, 0}},
      {&out.u3v, {3, 1, 0}}, {&out.u2v2, {2, 2, 0}}, {&out.uv3, {1, 3, 0}}, {&out.v4, {0, 4, 0}},
      {&out.u3, {3, 0, 0}},  {&out.u2v, {2, 1, 0}},  {&out.uv2, {1, 2, 0}}, {&out.v3, {0, 3, 0}},
      {&out.uun, {2, 0, 1}}, {&out.uvn, {1, 1, 1}},  {&out.vvn, {0, 2, 1}}, {&out.un, {1, 0, 1}},
      {&out.vn, {0, 1, 1}},
  };
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    Input rotated = points;
    for (std::size_t i = 0; i < 40; ++i) {
      const MomentPoints& p = points.points;
      const auto along = [&](const QueryVectors& axis) {
        return axis.x[q] * p.x[i] + axis.y[q] * p.y[i] + axis.z[q] * p.z[i];
      };
      rotated.points.x[i] = along(u);
      rotated.points.y[i] = along(v);
      rotated.points.z[i] = along(n);
    }
    for (const Case& one : cases) EXPECT_NEAR((*one.row)[q], expected(rotated, {}, q, one.powers), 1e-11);
  }
}

TEST(MomentKernels, SumsOfFewQueriesAreThoseOfThePowers) {
  Random random(5);
  Input some = random_input(random, 20);
  for (const std::size_t queries : {1U, 4U, 5U, 27U, 31U}) {
    for (QueryWord& word : some.words) word &= (QueryWord{1} << queries) - 1;
    for (const Isa isa : available_isas()) {
      const auto by_word = std::make_unique<MomentsByWord>();
      QueryMoments sums{};
      moment_kernels(isa).add_powers_by_word(some.points, some.words, queries, *by_word);
      moment_kernels(isa).collect({}, *by_word, sums);
      for (std::size_t q = 0; q < queries; ++q) {
        EXPECT_NEAR(sums.at[moment_index(1, 2, 1)][q], expected({}, some, q, {1, 2, 1}), 1e-13);
      }
    }
    some = random_input(random, 20);
  }
}

struct Normals {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;

  void add(const Point& normal) {
    x.push_back(normal.x);
    y.push_back(normal.y);
    z.push_back(normal.z);
  }
  [[nodiscard]] NormalColumns columns() const { return {x.data(), y.data(), z.data()}; }
};

TEST(MomentKernels, FacingComparesTheRoundedProductWithZero) {
  FacingTest test{};
  test.normals.x = {1, -1, 0, 0, std::nan("")};
  test.normals.y = {0, 0, 1};
  test.normals.z = {0, 0, 0, 1e-300};
  test.axis = {1, 0, 0};
  test.all = 2;  // leaves all undecided
  Normals normals;
  normals.add({0.5, 0, 0.5});
  normals.add({std::nan(""), 0, 1});
  normals.add({0.5, 0, 0.5});
  for (const Isa isa : available_isas()) {
    std::vector<QueryWord> words{~QueryWord{0}, ~QueryWord{0}, 0b01110U};
    moment_kernels(isa).keep_facing(normals.columns(), test, words);
    EXPECT_THAT(words, testing::ElementsAre(0b01001U, 0U, 0b01000U));
  }
}

TEST(MomentKernels, TheAxisDecidesOnlyBeyondItsBound) {
  FacingTest test{};
  test.normals.x.fill(-1);  // so that the products would decide otherwise
  test.axis = {1, 0, 0};
  test.all = 0.5;
  Normals normals;
  for (const double x : {1.0, 0.5, -0.5, -1.0, std::nan("")}) normals.add({x, 0, 0});
  for (const Isa isa : available_isas()) {
    std::vector<QueryWord> words(5, 0b11U);
    moment_kernels(isa).keep_facing(normals.columns(), test, words);
    EXPECT_THAT(words, testing::ElementsAre(0b11U, 0U, 0b11U, 0U, 0U));
  }
}

TEST(MomentKernels, EveryInstructionSetGivesTheSameBits) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const Input common = random_input(random, random.below(65));
    const Input some = random_input(random, random.below(65));
    const QueryVectors by = random_vectors(random);
    const QueryVectors u = random_vectors(random);
    const QueryVectors v = random_vectors(random);
    const FacingTest test{.normals = u, .axis = {0.6, 0, 0.8}, .all = 0.5};
    const std::size_t leaf = std::min<std::size_t>(some.words.size(), kLeafCapacity);
    const NormalColumns normals{some.points.x.data(), some.points.y.data(), some.points.z.data()};
    std::vector<std::vector<QueryWord>> facing;
    std::vector<FrameMoments> results;
    for (const Isa isa : available_isas()) {
      const MomentKernels& kernels = moment_kernels(isa);
      QueryMoments moments = collected(kernels, common, some);
      kernels.shift(moments, by);
      kernels.rotate(moments, u, v, by, results.emplace_back());
      facing.emplace_back(some.words).resize(leaf);
      kernels.keep_facing(normals, test, facing.back());
    }
    EXPECT_THAT(facing, testing::Each(facing.front()));
    for (const FrameMoments& result : results) EXPECT_EQ(std::memcmp(&result, results.data(), sizeof(result)), 0);
  }
}

}  // namespace
}  // namespace meshhood::test
