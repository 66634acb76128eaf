// SPDX-License-Identifier: MIT
// The kernels of the moments compute the sums that they name, with the same bits for every instruction set.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
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

/// The sums of the queries of its words, which are followed by others.
std::unique_ptr<MomentsByQuery> summed(const MomentKernels& kernels, const Input& input) {
  std::array<QueryWord, MomentPoints::kCapacity + 15> words;
  words.fill(~QueryWord{0});
  std::copy(input.words.begin(), input.words.end(), words.begin());
  auto sums = std::make_unique<MomentsByQuery>();
  kernels.add_powers_by_word(input.points, std::span(words).first(input.words.size()), *sums);
  return sums;
}

/// The sums of an input, without words and with them.
QueryMoments collected(const MomentKernels& kernels, const Input& common, const Input& some) {
  PartialMoments parts{};
  QueryMoments out{};
  kernels.add_powers(common.points, common.words.size(), parts);
  kernels.collect(parts, *summed(kernels, some), out);
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
  QueryMoments moments = collected(moment_kernels(Isa{}), points, {});
  moment_kernels(Isa{}).shift(moments, by);
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
  const QueryMoments moments = collected(moment_kernels(Isa{}), points, {});
  const QueryVectors u = random_vectors(random);
  const QueryVectors v = random_vectors(random);
  const QueryVectors n = random_vectors(random);
  FrameMoments out{};
  moment_kernels(Isa{}).rotate(moments, u, v, n, out);
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
      QueryMoments sums{};
      moment_kernels(isa).collect({}, *summed(moment_kernels(isa), some), sums);
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
  test.set(0, {1, 0, 0});
  test.set(1, {-1, 0, 0});
  test.set(2, {0, 1, 0});
  test.set(3, {0, 0, 1e-300});
  test.set(4, {std::nan(""), 0, 0});
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

TEST(MomentKernels, FacingIsThatOfDoublesWhereFloatsCannotDecide) {
  const double x = std::cos(0.7);
  const double y = std::sin(0.7);
  FacingTest test{};
  test.all = 2;  // leaves all undecided
  for (std::size_t q = 0; q < kPacketCapacity; ++q) test.set(q, {x, y, 0});
  Normals normals;
  std::vector<QueryWord> expected;
  for (int exponent = -45; exponent < -10; ++exponent) {
    for (const double product : {std::ldexp(1.0, exponent), -std::ldexp(1.0, exponent)}) {
      normals.add({product * x - y, product * y + x, 0});
      expected.push_back(product > 0 ? ~QueryWord{0} : 0);
    }
  }
  for (const Isa isa : available_isas()) {
    for (std::size_t first = 0; first < expected.size(); first += 5) {
      std::vector<QueryWord> words(5, ~QueryWord{0});
      moment_kernels(isa).keep_facing({&normals.x[first], &normals.y[first], &normals.z[first]}, test, words);
      EXPECT_THAT(words, testing::ElementsAreArray(std::span(expected).subspan(first, 5)));
    }
  }
}

TEST(MomentKernels, TheAxisDecidesOnlyBeyondItsBound) {
  FacingTest test{};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) test.set(q, {-1, 0, 0});  // the products would decide otherwise
  test.axis = {1, 0, 0};
  test.all = 0.5;
  Normals normals;
  for (const double x : {1.0, 0.5, -0.4, -1.0, std::nan("")}) normals.add({x, 0, 0});
  for (const Isa isa : available_isas()) {
    std::vector<QueryWord> words(5, 0b11U);
    moment_kernels(isa).keep_facing(normals.columns(), test, words);
    EXPECT_THAT(words, testing::ElementsAre(0b11U, 0U, 0b11U, 0U, 0U));
  }
}

void expect_equal(const VertexList& a, const VertexList& b) {
  ASSERT_EQ(a.size, b.size);
  EXPECT_TRUE(std::equal(a.places.begin(), a.places.begin() + static_cast<std::ptrdiff_t>(a.size), b.places.begin()));
  EXPECT_TRUE(std::equal(a.words.begin(), a.words.begin() + static_cast<std::ptrdiff_t>(a.size), b.words.begin()));
}

/// Where a fit is not unique, its numbers have no meaning.
void expect_equal(const QueryQuadrics& a, const QueryQuadrics& b) {
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    ASSERT_EQ(a.determinant[q] > 0, b.determinant[q] > 0);
    if (!(a.determinant[q] > 0)) continue;
    EXPECT_EQ(a.determinant[q], b.determinant[q]);
    EXPECT_THAT((std::array{a.a[q], a.b[q], a.c[q], a.d[q], a.e[q]}),
                testing::ElementsAre(b.a[q], b.b[q], b.c[q], b.d[q], b.e[q]));
  }
}

TEST(MomentKernels, VerticesGoToTheListOfTheirWord) {
  for (const Isa isa : available_isas()) {
    VertexList common{};
    VertexList some{};
    for (const std::uint32_t first : {40U, 90U}) {
      std::vector<QueryWord> words(kLeafCapacity, 0b100);
      std::fill_n(words.begin(), 19, 0);
      words[0] = words[17] = 0b111;
      words[3] = 0b100;
      words[18] = 0b010;
      moment_kernels(isa).append(first, std::span(words).first(19), 0b111, common, some);
    }
    EXPECT_THAT(std::span(common.places).first(common.size), testing::ElementsAre(40, 57, 90, 107));
    EXPECT_THAT(std::span(some.places).first(some.size), testing::ElementsAre(43, 58, 93, 108));
    EXPECT_THAT(std::span(some.words).first(some.size), testing::ElementsAre(0b100, 0b010, 0b100, 0b010));
  }
}

TEST(MomentKernels, FitsSolveTheNormalEquations) {
  Random random(6);
  FrameMoments s{};
  QueryVectors sums{};
  alignas(QueryVectors) QueryRow counts{};
  const std::array<double, 6> coefficients{0.5, -0.25, 0.125, 0.75, -1, 2};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    for (int i = 0; i < 30; ++i) {
      const double u = random.uniform(-1, 1);
      const double v = random.uniform(-1, 1);
      const auto& [a, b, c, d, e, f] = coefficients;
      const double n = a * u * u + b * u * v + c * v * v + d * u + e * v + (q % 2 == 0 ? 0 : f);
      const auto add = [q](QueryRow& row, double term) { row[q] += term; };
      add(s.uu, u * u), add(s.uv, u * v), add(s.vv, v * v);
      add(s.u4, u * u * u * u), add(s.u3v, u * u * u * v), add(s.u2v2, u * u * v * v), add(s.uv3, u * v * v * v);
      add(s.v4, v * v * v * v), add(s.u3, u * u * u), add(s.u2v, u * u * v), add(s.uv2, u * v * v);
      add(s.v3, v * v * v), add(s.uun, u * u * n), add(s.uvn, u * v * n), add(s.vvn, v * v * n);
      add(s.un, u * n), add(s.vn, v * n);
      add(sums.x, u), add(sums.y, v), add(sums.z, n), add(counts, 1);
    }
  }
  for (const Isa isa : available_isas()) {
    QueryQuadrics quadrics{};
    QueryQuadrics jets{};
    moment_kernels(isa).fit_quadrics(s, quadrics);
    moment_kernels(isa).fit_jets(s, sums, counts, jets);
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      const auto expect = [&](const QueryQuadrics& fit) {
        const std::array<double, 5> found{fit.a[q], fit.b[q], fit.c[q], fit.d[q], fit.e[q]};
        for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(found[i], coefficients[i], 1e-12);
        EXPECT_GT(fit.determinant[q], 1e-4);
        EXPECT_LE(fit.determinant[q], 1);
      };
      expect(jets);
      if (q % 2 == 0) expect(quadrics);
    }
  }
}

TEST(MomentKernels, ASingularFitHasNoPositiveDeterminant) {
  FrameMoments s{};  // of the points (1, 1) and (2, 2) in query 1, of none in the others
  for (QueryRow* const row : {&s.uu, &s.uv, &s.vv}) (*row)[1] = 5;
  for (QueryRow* const row : {&s.u3, &s.u2v, &s.uv2, &s.v3}) (*row)[1] = 9;
  for (QueryRow* const row : {&s.u4, &s.u3v, &s.u2v2, &s.uv3, &s.v4}) (*row)[1] = 17;
  for (const Isa isa : available_isas()) {
    QueryQuadrics fits{};
    moment_kernels(isa).fit_quadrics(s, fits);
    EXPECT_FALSE(fits.determinant[0] > 0);
    EXPECT_FALSE(fits.determinant[1] > 0);
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
    FacingTest test{};
    for (std::size_t q = 0; q < kPacketCapacity; ++q) test.set(q, {u.x[q], u.y[q], u.z[q]});
    test.axis = {0.6, 0, 0.8};
    test.all = 0.5;
    const std::size_t leaf = std::min<std::size_t>(some.words.size(), kLeafCapacity);
    const NormalColumns normals{some.points.x.data(), some.points.y.data(), some.points.z.data()};
    std::vector<std::vector<QueryWord>> facing;
    std::vector<FrameMoments> results;
    std::vector<std::array<QueryQuadrics, 2>> fits;
    std::vector<std::array<VertexList, 2>> lists;
    for (const Isa isa : available_isas()) {
      const MomentKernels& kernels = moment_kernels(isa);
      QueryMoments moments = collected(kernels, common, some);
      kernels.shift(moments, by);
      kernels.rotate(moments, u, v, by, results.emplace_back());
      facing.emplace_back(some.words).resize(leaf);
      kernels.keep_facing(normals, test, facing.back());
      auto& [in_common, in_some] = lists.emplace_back();
      std::vector<QueryWord> padded = facing.back();
      padded.resize(kLeafCapacity);
      kernels.append(100, std::span(padded).first(leaf), 0b11, in_common, in_some);
      fits.emplace_back();
      kernels.fit_quadrics(results.back(), fits.back()[0]);
      kernels.fit_jets(results.back(), by, moments.at[0], fits.back()[1]);
    }
    EXPECT_THAT(facing, testing::Each(facing.front()));
    for (const FrameMoments& result : results) EXPECT_EQ(std::memcmp(&result, results.data(), sizeof(result)), 0);
    for (const auto& [quadrics, jets] : fits) {
      expect_equal(quadrics, fits.front()[0]);
      expect_equal(jets, fits.front()[1]);
    }
    for (const auto& [in_common, in_some] : lists) {
      expect_equal(in_common, lists.front()[0]);
      expect_equal(in_some, lists.front()[1]);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
