// SPDX-License-Identifier: MIT
// The kernels of the moments compute the sums that they name, with the same bits for every instruction set.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
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

/// Points, up to 64, with a word for each.
struct Input {
  std::array<MomentPoints, 2> leaves{};
  std::vector<QueryWord> words;

  [[nodiscard]] std::size_t size() const { return words.size(); }
  [[nodiscard]] LaneMask lanes(std::size_t first) const {
    return first_lanes(static_cast<unsigned>(std::min<std::size_t>(size() - first, kLeafCapacity)));
  }
  [[nodiscard]] Point at(std::size_t i) const {
    const MomentPoints& points = leaves[i / kLeafCapacity];
    return {points.x[i % kLeafCapacity], points.y[i % kLeafCapacity], points.z[i % kLeafCapacity]};
  }
  [[nodiscard]] double weight(std::size_t i) const { return leaves[i / kLeafCapacity].weight[i % kLeafCapacity]; }
  void set(std::size_t i, const Point& p) { leaves[i / kLeafCapacity].set(i % kLeafCapacity, p, weight(i)); }
};

Input random_input(Random& random, std::size_t size) {
  Input input;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    input.leaves[i / kLeafCapacity].set(i % kLeafCapacity, {x, y, z}, random.uniform(0, 2));
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

/// The powers of each point, added to the sums of the queries of its word. The words are followed by others.
QueryMoments summed(const MomentKernels& kernels, const Input& input) {
  constexpr std::size_t kMost = 64;
  const auto terms = std::make_unique<std::array<PaddedMoments, kMost>>();
  std::array<QueryWord, kMost + 15> words;
  words.fill(~QueryWord{0});
  std::copy(input.words.begin(), input.words.end(), words.begin());
  for (std::size_t first = 0; first < input.size(); first += kLeafCapacity) {
    kernels.powers(input.leaves[first / kLeafCapacity], input.lanes(first), &(*terms)[first]);
  }
  const auto sums = std::make_unique<MomentsByQuery>();
  kernels.add_terms(terms->data(), std::span(words).first(input.size()), *sums);
  QueryMoments out{};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    for (std::size_t m = 0; m < kMomentCount; ++m) out.at[m][q] = (*sums)[q].at[m];
  }
  return out;
}

/// The same sums for each query: those of all points.
QueryMoments summed_for_all(const MomentKernels& kernels, Input input) {
  std::fill(input.words.begin(), input.words.end(), ~QueryWord{0});
  return summed(kernels, input);
}

double term(const Input& input, std::size_t i, const Powers& n) {
  const Point p = input.at(i);
  return input.weight(i) * power(p.x, n.i) * power(p.y, n.j) * power(p.z, n.k);
}

double expected(const Input& input, std::size_t query, const Powers& n) {
  double sum = 0;
  for (std::size_t i = 0; i < input.size(); ++i) {
    if ((input.words[i] >> query & 1U) != 0) sum += term(input, i, n);
  }
  return sum;
}

double expected_for_all(const Input& input, const Powers& n) {
  double sum = 0;
  for (std::size_t i = 0; i < input.size(); ++i) sum += term(input, i, n);
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
  for (const std::size_t size : {0U, 1U, 7U, 8U, 9U, 33U, 63U, 64U}) {
    const Input input = random_input(random, size);
    for (const Isa isa : available_isas()) {
      const QueryMoments sums = summed(moment_kernels(isa), input);
      for (const Powers& n : all_powers()) {
        for (std::size_t q = 0; q < kPacketCapacity; ++q) {
          EXPECT_NEAR(sums.at[moment_index(n.i, n.j, n.k)][q], expected(input, q, n), 1e-13);
        }
      }
    }
  }
}

TEST(MomentKernels, TermsAreAddedOneAfterTheOther) {
  Random random(7);
  const Input input = random_input(random, 50);
  for (const Isa isa : available_isas()) {
    const MomentKernels& kernels = moment_kernels(isa);
    std::vector<PaddedMoments> terms(64);
    for (std::size_t i = 0; i < 50; ++i) terms[i].at.fill(input.at(i).x);
    std::vector<QueryWord> words = input.words;
    words.resize(65, ~QueryWord{0});
    MomentsByQuery sums{};
    for (PaddedMoments& sum : sums) sum.at.fill(0x1p53);  // so that another order gives other bits
    const MomentsByQuery before = sums;
    kernels.add_terms(terms.data(), std::span(words).first(20), sums);
    kernels.add_terms(&terms[20], std::span(words).subspan(20, 30), sums);
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      double sum = before[q].at[0];
      for (std::size_t i = 0; i < 50; ++i) {
        if ((input.words[i] >> q & 1U) != 0) sum += input.at(i).x;
      }
      EXPECT_THAT(sums[q].at, testing::Each(sum));
    }
  }
}

TEST(MomentKernels, PowersAreThoseOfTheChosenPoints) {
  Random random(8);
  const Input input = random_input(random, kLeafCapacity);
  for (const LaneMask chosen : {0xFFFFFFFFU, 0U, 1U, 0x80000000U, 0x12345678U, 0x00F000FFU}) {
    for (const Isa isa : available_isas()) {
      PerLane<PaddedMoments> powers{};
      moment_kernels(isa).powers(input.leaves[0], chosen, powers.data());
      std::size_t at = 0;
      for_each_lane(chosen, [&](unsigned lane) {
        for (const Powers& n : all_powers()) {
          EXPECT_NEAR(powers[at].at[moment_index(n.i, n.j, n.k)], term(input, lane, n), 1e-15);
        }
        ++at;
      });
    }
  }
}

/// As `sum` of the kernels.
double sum_in_eight_parts(std::span<const PaddedMoments> powers, std::size_t m) {
  std::array<double, 8> parts{};
  for (std::size_t i = 0; i < powers.size(); ++i) parts[i % 8] += powers[i].at[m];
  return ((parts[0] + parts[4]) + (parts[2] + parts[6])) + ((parts[1] + parts[5]) + (parts[3] + parts[7]));
}

TEST(MomentKernels, TheSumOfALeafHasEightPartialSums) {
  Random random(9);
  for (std::size_t size = 1; size <= kLeafCapacity; ++size) {
    Input input = random_input(random, size);
    for (std::size_t i = size; i < kLeafCapacity; ++i) input.leaves[0].weight[i] = std::nan("");
    for (std::size_t i = (size + 7) / 8 * 8; i < kLeafCapacity; ++i) input.leaves[0].x[i] = std::nan("");
    for (const Isa isa : available_isas()) {
      PerLane<PaddedMoments> powers{};
      PaddedMoments sum;
      moment_kernels(isa).powers(input.leaves[0], first_lanes(static_cast<unsigned>(size)), powers.data());
      moment_kernels(isa).sum(input.leaves[0], size, sum);
      for (std::size_t m = 0; m < kMomentCount; ++m) {
        EXPECT_EQ(sum.at[m], sum_in_eight_parts(std::span(powers).first(size), m));
      }
    }
  }
}

template <class Real>
void expect_points(Random& random,
                   void (*MomentKernels::*set_points)(const Real*, std::size_t, const Point&, double, MomentPoints&)) {
  std::vector<Real> xyz(3 * kLeafCapacity);
  for (Real& coordinate : xyz) coordinate = static_cast<Real>(random.uniform(-1, 1));
  const Point center{0.3, -0.2, 0.1};
  for (const std::size_t size : {1U, 7U, 8U, 21U, 32U}) {
    std::vector<Real> values = xyz;
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(3 * size), values.end(), std::numeric_limits<Real>::max());
    for (const Isa isa : available_isas()) {
      MomentPoints points{};
      points.x.fill(std::nan(""));
      points.weight.fill(5);
      (moment_kernels(isa).*set_points)(values.data(), size, center, 0x1p600, points);
      for (std::size_t i = 0; i < (size + 7) / 8 * 8; ++i) {
        const bool exists = i < size;
        const auto coordinate = [&](std::size_t axis) { return static_cast<double>(values[3 * i + axis]); };
        EXPECT_EQ(points.x[i], exists ? (coordinate(0) - center.x) * 0x1p600 : 0);
        EXPECT_EQ(points.y[i], exists ? (coordinate(1) - center.y) * 0x1p600 : 0);
        EXPECT_EQ(points.z[i], exists ? (coordinate(2) - center.z) * 0x1p600 : 0);
        EXPECT_EQ(points.weight[i], 5);
      }
    }
  }
}

TEST(MomentKernels, PointsAreRelativeToTheCenterAndOthersZero) {
  Random random(10);
  expect_points<float>(random, &MomentKernels::set_points_float);
  expect_points<double>(random, &MomentKernels::set_points_double);
}

TEST(MomentKernels, ShiftedMomentsAreThoseOfShiftedPoints) {
  Random random(2);
  const Input points = random_input(random, 40);
  const QueryVectors by = random_vectors(random);
  QueryMoments moments = summed_for_all(moment_kernels(Isa{}), points);
  moment_kernels(Isa{}).shift(moments, by);
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    Input shifted = points;
    for (std::size_t i = 0; i < 40; ++i) {
      const Point p = points.at(i);
      shifted.set(i, {p.x + by.x[q], p.y + by.y[q], p.z + by.z[q]});
    }
    for (const Powers& n : all_powers()) {
      EXPECT_NEAR(moments.at[moment_index(n.i, n.j, n.k)][q], expected_for_all(shifted, n), 1e-11);
    }
  }
}

TEST(MomentKernels, RotatedMomentsAreThoseOfRotatedPoints) {
  Random random(3);
  const Input points = random_input(random, 40);
  const QueryMoments moments = summed_for_all(moment_kernels(Isa{}), points);
  const QueryVectors u = random_vectors(random);
  const QueryVectors v = random_vectors(random);
  const QueryVectors n = random_vectors(random);
  FrameMoments out{};
  moment_kernels(Isa{}).rotate(moments, {u, v, n}, out);
  struct Case {
    const QueryRow* row;
    Powers powers;
  };
  const std::vector<Case> cases{
      {&out.uu, {2, 0, 0}},  {&out.uv, {1, 1, 0}},   {&out.vv, {0, 2, 0}},  {&out.u4, {4, 0, 0}},
      {&out.u3v, {3, 1, 0}}, {&out.u2v2, {2, 2, 0}}, {&out.uv3, {1, 3, 0}}, {&out.v4, {0, 4, 0}},
      {&out.u3, {3, 0, 0}},  {&out.u2v, {2, 1, 0}},  {&out.uv2, {1, 2, 0}}, {&out.v3, {0, 3, 0}},
      {&out.uun, {2, 0, 1}}, {&out.uvn, {1, 1, 1}},  {&out.vvn, {0, 2, 1}}, {&out.un, {1, 0, 1}},
      {&out.vn, {0, 1, 1}},  {&out.u, {1, 0, 0}},    {&out.v, {0, 1, 0}},   {&out.n, {0, 0, 1}},
      {&out.one, {0, 0, 0}},
  };
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    Input rotated = points;
    for (std::size_t i = 0; i < 40; ++i) {
      const Point p = points.at(i);
      const auto along = [&](const QueryVectors& axis) { return axis.x[q] * p.x + axis.y[q] * p.y + axis.z[q] * p.z; };
      rotated.set(i, {along(u), along(v), along(n)});
    }
    for (const Case& one : cases) EXPECT_NEAR((*one.row)[q], expected_for_all(rotated, one.powers), 1e-11);
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
  test.normals.set(0, {1, 0, 0});
  test.normals.set(1, {-1, 0, 0});
  test.normals.set(2, {0, 1, 0});
  test.normals.set(3, {0, 0, 1e-300});
  test.normals.set(4, {std::nan(""), 0, 0});
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

TEST(MomentKernels, FacingIsThatOfDoublesNearARightAngle) {
  const double x = std::cos(0.7);
  const double y = std::sin(0.7);
  FacingTest test{};
  test.all = 2;  // leaves all undecided
  for (std::size_t q = 0; q < kPacketCapacity; ++q) test.normals.set(q, {x, y, 0});
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
  for (std::size_t q = 0; q < kPacketCapacity; ++q)
    test.normals.set(q, {-1, 0, 0});  // the products would decide otherwise
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

TEST(MomentKernels, FitsSolveTheNormalEquations) {
  Random random(6);
  FrameMoments s{};
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
      add(s.u, u), add(s.v, v), add(s.n, n), add(s.one, 1);
    }
  }
  for (const Isa isa : available_isas()) {
    QueryQuadrics quadrics{};
    QueryQuadrics jets{};
    moment_kernels(isa).fit_quadrics(s, quadrics);
    moment_kernels(isa).fit_jets(s, jets);
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

/// Among them flat, equally bent and steep ones.
QueryQuadrics random_quadrics(Random& random) {
  QueryQuadrics quadrics{};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    const double bend = q % 8 == 0 ? 0 : 2;
    const double slope = q % 5 == 0 ? 0 : (q % 5 == 1 ? 1e6 : 2);
    quadrics.a[q] = random.uniform(-bend, bend);
    quadrics.b[q] = q % 4 == 1 ? 0 : random.uniform(-bend, bend);
    quadrics.c[q] = q % 4 == 1 ? quadrics.a[q] : random.uniform(-bend, bend);
    quadrics.d[q] = random.uniform(-slope, slope);
    quadrics.e[q] = random.uniform(-slope, slope);
  }
  return quadrics;
}

QueryFrames random_frames(Random& random) {
  QueryFrames frames{};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    const double angle = q == 0 ? 0 : random.uniform(0, 6);
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    frames.u.set(q, {x, 0, y});
    frames.v.set(q, {-0.6 * y, -0.8, 0.6 * x});
    frames.n.set(q, {0.8 * y, -0.6, -0.8 * x});
  }
  return frames;
}

/// All numbers of a query; NaN as the same bits, because processors differ in its sign.
std::array<std::uint64_t, 8> bits_of(const QueryCurvatures& from, std::size_t q) {
  std::array<std::uint64_t, 8> bits{};
  std::size_t i = 0;
  for (const double number :
       {from.k1[q], from.k2[q], from.d1.x[q], from.d1.y[q], from.d1.z[q], from.d2.x[q], from.d2.y[q], from.d2.z[q]}) {
    bits[i++] = std::bit_cast<std::uint64_t>(std::isnan(number) ? std::nan("") : number);
  }
  return bits;
}

/// One query alone.
QueryCurvatures curvatures_alone(const MomentKernels& kernels, const QueryQuadrics& quadrics, const QueryFrames& frames,
                                 std::size_t q, bool of_libigl) {
  QueryQuadrics quadric{};
  quadric.a[0] = quadrics.a[q];
  quadric.b[0] = quadrics.b[q];
  quadric.c[0] = quadrics.c[q];
  quadric.d[0] = quadrics.d[q];
  quadric.e[0] = quadrics.e[q];
  QueryFrames frame{};
  frame.u.set(0, frames.u.at(q));
  frame.v.set(0, frames.v.at(q));
  frame.n.set(0, frames.n.at(q));
  QueryCurvatures out{};
  const auto find = of_libigl ? kernels.principal_curvatures_of_libigl : kernels.principal_curvatures;
  find(quadric, frame, 1, out);
  return out;
}

TEST(MomentKernels, PrincipalCurvaturesHaveTheSameBitsTogetherAndAloneOnEveryInstructionSet) {
  Random random(11);
  for (int round = 0; round < 20; ++round) {
    QueryQuadrics quadrics = random_quadrics(random);
    QueryFrames frames = random_frames(random);
    quadrics.b[7] = std::numeric_limits<double>::infinity();
    frames.n.set(9, {std::nan(""), std::nan(""), std::nan("")});
    for (const Isa isa : available_isas()) {
      const MomentKernels& kernels = moment_kernels(isa);
      for (const bool of_libigl : {false, true}) {
        QueryCurvatures out{};
        const auto find = of_libigl ? kernels.principal_curvatures_of_libigl : kernels.principal_curvatures;
        find(quadrics, frames, kPacketCapacity, out);
        for (std::size_t q = 0; q < kPacketCapacity; ++q) {
          const QueryCurvatures alone = curvatures_alone(moment_kernels(Isa{}), quadrics, frames, q, of_libigl);
          EXPECT_EQ(bits_of(out, q), bits_of(alone, 0)) << "query " << q;
        }
      }
    }
  }
}

/// Of all kinds: along axes, with components that are equal, and none.
QueryVectors random_normals(Random& random) {
  QueryVectors normals{};
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    Point n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (q % 8 == 1) n = {0, 0, q % 16 == 1 ? 1.0 : -1.0};
    if (q % 8 == 2) n = {n.x, n.x, n.z};
    if (q % 8 == 3) n = {n.x, n.y, -n.y};
    if (q % 8 == 4) n = {n.z, n.y, n.z};
    if (q % 8 == 5) n = {-n.x, n.x, n.x};
    const double size = std::sqrt(squared_distance(n, {0, 0, 0}));
    normals.set(q, {n.x / size, n.y / size, n.z / size});
  }
  normals.set(7, {std::nan(""), std::nan(""), std::nan("")});
  return normals;
}

TEST(MomentKernels, TangentsBeginWithTheAxisFarthestFromTheNormal) {
  Random random(14);
  for (int round = 0; round < 20; ++round) {
    QueryFrames frames{};
    frames.n = random_normals(random);
    moment_kernels(best_isa()).set_tangents(kPacketCapacity, frames);
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      const Point n = frames.n.at(q);
      const Point u = frames.u.at(q);
      const Point v = frames.v.at(q);
      if (q == 7) {
        EXPECT_TRUE(std::isnan(u.x) && std::isnan(v.x));
        continue;
      }
      EXPECT_NEAR(squared_distance(u, {0, 0, 0}), 1, 1e-15);
      EXPECT_NEAR(u.x * n.x + u.y * n.y + u.z * n.z, 0, 1e-15);
      EXPECT_EQ(v.x, n.y * u.z - n.z * u.y);
      EXPECT_EQ(v.y, n.z * u.x - n.x * u.z);
      EXPECT_EQ(v.z, n.x * u.y - n.y * u.x);
      // Of equal ones the first. What is left of the axis lies more than half along it.
      const std::array<double, 3> sizes{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
      const auto farthest = std::min_element(sizes.begin(), sizes.end()) - sizes.begin();
      EXPECT_GT((std::array{u.x, u.y, u.z}[static_cast<std::size_t>(farthest)]), 0.8);
    }
  }
}

TEST(MomentKernels, TangentsHaveTheSameBitsTogetherAndAloneOnEveryInstructionSet) {
  const auto bits = [](double number) {
    return std::bit_cast<std::uint64_t>(std::isnan(number) ? std::nan("") : number);
  };
  Random random(15);
  for (int round = 0; round < 20; ++round) {
    const QueryVectors normals = random_normals(random);
    for (const Isa isa : available_isas()) {
      QueryFrames frames{};
      frames.n = normals;
      moment_kernels(isa).set_tangents(kPacketCapacity, frames);
      for (std::size_t q = 0; q < kPacketCapacity; ++q) {
        QueryFrames alone{};
        alone.n.set(0, normals.at(q));
        moment_kernels(Isa{}).set_tangents(1, alone);
        for (const auto& [found, expected] :
             {std::pair(frames.u.at(q), alone.u.at(0)), {frames.v.at(q), alone.v.at(0)}}) {
          EXPECT_EQ(bits(found.x), bits(expected.x)) << "query " << q;
          EXPECT_EQ(bits(found.y), bits(expected.y)) << "query " << q;
          EXPECT_EQ(bits(found.z), bits(expected.z)) << "query " << q;
        }
      }
    }
  }
}

TEST(MomentKernels, DirectionsAreUnitVectorsWhoseLargestComponentIsPositive) {
  Random random(12);
  const QueryQuadrics quadrics = random_quadrics(random);
  const QueryFrames frames = random_frames(random);
  QueryCurvatures out{};
  moment_kernels(best_isa()).principal_curvatures(quadrics, frames, kPacketCapacity, out);
  for (std::size_t q = 0; q < kPacketCapacity; ++q) {
    EXPECT_GE(out.k1[q], out.k2[q]);
    for (const Point& p : {out.d1.at(q), out.d2.at(q)}) {
      EXPECT_NEAR(p.x * p.x + p.y * p.y + p.z * p.z, 1, 1e-15);
      EXPECT_EQ(std::max({p.x, p.y, p.z}), std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
    }
  }
}

TEST(MomentKernels, AFlatQuadricHasNoDirectionsByLibigl) {
  const QueryFrames frames = [] {
    Random random(13);
    return random_frames(random);
  }();
  for (const Isa isa : available_isas()) {
    QueryCurvatures out{};
    out.d1.x.fill(5);
    out.d2.z.fill(5);
    moment_kernels(isa).principal_curvatures_of_libigl({}, frames, kPacketCapacity, out);
    for (std::size_t q = 0; q < kPacketCapacity; ++q) {
      for (const Point& p : {out.d1.at(q), out.d2.at(q)}) EXPECT_EQ(squared_distance(p, {0, 0, 0}), 0);
    }
    moment_kernels(isa).principal_curvatures({}, frames, kPacketCapacity, out);
    EXPECT_EQ(out.d2.x[0], 1);
    EXPECT_NEAR(out.d1.y[0], 0.8, 1e-15);
  }
}

TEST(MomentKernels, EveryInstructionSetGivesTheSameBits) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const Input input = random_input(random, 1 + random.below(64));
    const QueryVectors by = random_vectors(random);
    const QueryVectors u = random_vectors(random);
    const QueryVectors v = random_vectors(random);
    FacingTest test{};
    for (std::size_t q = 0; q < kPacketCapacity; ++q) test.normals.set(q, {u.x[q], u.y[q], u.z[q]});
    test.axis = {0.6, 0, 0.8};
    test.all = 0.5;
    const std::size_t leaf = std::min<std::size_t>(input.size(), kLeafCapacity);
    const MomentPoints& points = input.leaves[0];
    std::vector<std::vector<QueryWord>> facing;
    std::vector<FrameMoments> results;
    std::vector<std::array<QueryQuadrics, 2>> fits;
    std::vector<PaddedMoments> sums;
    for (const Isa isa : available_isas()) {
      const MomentKernels& kernels = moment_kernels(isa);
      QueryMoments moments = summed(kernels, input);
      kernels.shift(moments, by);
      kernels.rotate(moments, {u, v, by}, results.emplace_back());
      facing.emplace_back(input.words).resize(leaf);
      kernels.keep_facing({points.x.data(), points.y.data(), points.z.data()}, test, facing.back());
      fits.emplace_back();
      kernels.fit_quadrics(results.back(), fits.back()[0]);
      kernels.fit_jets(results.back(), fits.back()[1]);
      kernels.sum(points, leaf, sums.emplace_back());
    }
    EXPECT_THAT(facing, testing::Each(facing.front()));
    for (const FrameMoments& result : results) EXPECT_EQ(std::memcmp(&result, results.data(), sizeof(result)), 0);
    for (const auto& [quadrics, jets] : fits) {
      expect_equal(quadrics, fits.front()[0]);
      expect_equal(jets, fits.front()[1]);
    }
    for (const PaddedMoments& sum : sums) {
      EXPECT_EQ(std::memcmp(&sum, sums.data(), kMomentCount * sizeof(double)), 0);
    }
  }
}

}  // namespace
}  // namespace meshhood::test
