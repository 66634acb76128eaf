// SPDX-License-Identifier: MIT
// Aggregates equal their definitions over the vertices that breadth-first search finds.
#include "meshhood/aggregate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "support/draw_start.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/reports.h"
#include "support/scale.h"
#include "support/without_walls.h"

namespace meshhood::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsNan;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array kReductions{Reduce::Sum,     Reduce::Mean,     Reduce::Minimum,
                                 Reduce::Maximum, Reduce::Variance, Reduce::StandardDeviation,
                                 Reduce::Count,   Reduce::Median,   Reduce::Quantile};
constexpr std::array kKernels{SmoothingKernel::Box, SmoothingKernel::Epanechnikov, SmoothingKernel::Biweight,
                              SmoothingKernel::Gaussian};

bool may_have_kernel(Reduce reduce) { return reduce == Reduce::Sum || reduce == Reduce::Mean; }

bool uses_weights(Reduce reduce) {
  return may_have_kernel(reduce) || reduce == Reduce::Variance || reduce == Reduce::StandardDeviation;
}

/// The same bits; any NaN equals any NaN.
std::vector<std::uint64_t> bits_of(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> bits;
  for (const double number : numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
  return bits;
}

/// A result, and by how much another may differ from it.
struct Expected {
  double value;
  double tolerance;
};

/// A vertex of a neighborhood, as a reduction sees it.
struct Item {
  double value;
  double weight;
  long double distance;
};

long double kernel_weight(SmoothingKernel kernel, long double distance, double radius) {
  if (kernel == SmoothingKernel::Box || radius == 0 || std::isinf(radius)) return 1;
  const long double ratio = distance / static_cast<long double>(radius);
  if (kernel == SmoothingKernel::Gaussian) return std::exp(-std::log(1000.0L) * std::min(1.0L, ratio * ratio));
  const long double weight = std::max(0.0L, 1 - ratio * ratio);
  return kernel == SmoothingKernel::Biweight ? weight * weight : weight;
}

double quantile_of(std::vector<Item> items, double quantile) {
  std::ranges::sort(items, {}, &Item::value);
  const double place = quantile * static_cast<double>(items.size() - 1);
  const long double lower = items[static_cast<std::size_t>(std::floor(place))].value;
  const long double upper = items[static_cast<std::size_t>(std::ceil(place))].value;
  if (lower == upper) return static_cast<double>(lower);
  return static_cast<double>(lower + (place - std::floor(place)) * (upper - lower));
}

/// The definitions, in long double.
Expected reduce_items(std::vector<Item> items, const AggregateQuery& query, double radius) {
  if (query.missing == MissingValues::Omit) {
    std::erase_if(items, [](const Item& item) { return std::isnan(item.value); });
  }
  if (uses_weights(query.reduce.front())) std::erase_if(items, [](const Item& item) { return item.weight == 0; });
  long double weights = 0;
  long double plain_weights = 0;
  long double sum = 0;
  long double size = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  bool has_nan = items.empty();
  for (const Item& item : items) {
    const long double weight = item.weight * kernel_weight(query.kernel, item.distance, radius);
    weights += weight;
    plain_weights += item.weight;
    sum += weight * item.value;
    size += item.weight * std::abs(static_cast<long double>(item.value));
    least = std::min(least, item.value);
    most = std::max(most, item.value);
    has_nan = has_nan || std::isnan(item.value);
  }
  const auto as_double = [](long double value) { return static_cast<double>(value); };
  switch (query.reduce.front()) {
    case Reduce::Count: return {static_cast<double>(items.size()), 0};
    case Reduce::Minimum: return {has_nan ? kNan : least, 0};
    case Reduce::Maximum: return {has_nan ? kNan : most, 0};
    case Reduce::Median: return {has_nan ? kNan : quantile_of(items, 0.5), 0};
    case Reduce::Quantile:
      return {has_nan ? kNan : quantile_of(items, query.quantile), 1e-15 * std::max(std::abs(least), std::abs(most))};
    case Reduce::Sum: return {as_double(sum), as_double(1e-13L * size)};
    case Reduce::Mean:
      // Weights that nearly vanish come from vertices at the rim alone, and are rounding.
      if (plain_weights == 0) return {kNan, 0};
      if (weights < 1e-9L * plain_weights) return {kNan, kInfinity};
      return {as_double(sum / weights), as_double(1e-13L * (size + std::abs(sum / weights) * plain_weights) / weights)};
    case Reduce::Variance:
    case Reduce::StandardDeviation: break;
  }
  if (weights == 0) return {kNan, 0};
  const long double mean = sum / weights;
  long double squares = 0;
  for (const Item& item : items) squares += item.weight * (item.value - mean) * (item.value - mean);
  const long double divisor = weights - query.ddof;
  if (!(divisor > 0)) return {kNan, 0};
  const long double variance = squares / divisor;
  const long double size_of_mean = size / weights;
  const long double tolerance = 1e-10L * variance + 1e-29L * size_of_mean * size_of_mean;
  if (query.reduce.front() == Reduce::Variance) return {as_double(variance), as_double(tolerance)};
  return {as_double(std::sqrt(variance)), as_double(std::sqrt(variance + tolerance) - std::sqrt(variance))};
}

/// A signal of several channels that owns its numbers.
struct TestSignal {
  std::size_t channels;
  std::vector<double> values;
  std::vector<double> weights;

  [[nodiscard]] SignalView view(bool weighted) const {
    return {values, channels, weighted ? std::span<const double>(weights) : std::span<const double>()};
  }
};

/// A smooth channel, noise on a large number, and values of all magnitudes; some weights are 0. With `gaps`, some
/// values are missing in the last two.
TestSignal make_signal(std::size_t vertices, bool gaps, Random& random) {
  TestSignal signal{3, {}, {}};
  for (std::size_t v = 0; v < vertices; ++v) {
    signal.values.push_back(static_cast<double>(v) / static_cast<double>(vertices));
    signal.values.push_back(gaps && random.below(4) == 0 ? kNan : 1e6 + random.uniform(-1, 1));
    const double sign = random.below(2) == 0 ? -1 : 1;
    signal.values.push_back(gaps && random.below(40) == 0 ? kNan : sign * std::exp2(random.uniform(-40, 40)));
    signal.weights.push_back(random.below(8) == 0 ? 0 : random.uniform(0.1, 2));
  }
  return signal;
}

/// A mesh, its index, and the definition of every aggregate.
class AggregateCase {
 public:
  explicit AggregateCase(TestMesh mesh) : mesh_(std::move(mesh)), index_(build(mesh_.view())), oracle_(mesh_) {}

  [[nodiscard]] const Index& index() const { return index_; }
  [[nodiscard]] std::size_t size() const { return mesh_.size(); }

  /// A radius that some distance between vertices is exactly, or one that is not.
  double radius(Random& random) {
    if (size() == 0) return 1;
    const auto any = [&] { return static_cast<VertexId>(random.below(size())); };
    switch (random.below(8)) {
      case 0: return 0;
      case 1: return kInfinity;
      case 2: return random.uniform(0.1, 3) * distance(mesh_.positions_view(), any(), any());
      default: return distance(mesh_.positions_view(), any(), any()) / static_cast<double>(1 + random.below(8));
    }
  }

  /// Compares all numbers of an aggregate with the definition.
  void compare(const SignalView& signal, const AggregateQuery& query, const Masks& masks = {}) {
    const std::vector<double> result = aggregate(masked(index_, masks), signal, query);
    const auto& scales = query.radius.scales();
    const std::size_t rows = query.vertices.count(size());
    ASSERT_EQ(result.size(), (scales ? scales->size() : 1) * rows * signal.channels);
    const Adjacency graph = without_walls(mesh_, masks.walls);
    ReferenceSearcher reference(GraphView{mesh_.positions_view(), graph.view()});
    const double largest = scales ? *std::max_element(scales->begin(), scales->end()) : 0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const std::size_t row = i / signal.channels % rows;
      const double radius = scales                ? (*scales)[i / signal.channels / rows]
                            : query.radius.list() ? (*query.radius.list())[row]
                                                  : query.radius.common();
      const VertexId v = query.vertices[row];
      const double searched = scales && query.nesting == Nesting::Patch ? largest : radius;
      if (query.metric == Metric::Straight) {
        reference.neighborhood(v, searched, ids_, distances_);
      } else if (query.metric == Metric::Space) {
        BallSearcher(mesh_.positions_view()).neighborhood(v, searched, ids_, distances_);
      } else if (i == 0 || v != paths_from_) {
        find_paths(v, masks.walls, query.metric);
      }
      const Expected expected =
          reduce_items(items(signal, i % signal.channels, v, query.metric, masks, radius), query, radius);
      const bool right = std::isnan(expected.value) ? std::isnan(result[i]) || std::isinf(expected.tolerance)
                                                    : std::abs(result[i] - expected.value) <= expected.tolerance;
      EXPECT_TRUE(right) << "vertex " << v << ", radius " << radius << ", channel " << i % signal.channels
                         << ", reduction " << static_cast<int>(query.reduce.front()) << ", kernel "
                         << static_cast<int>(query.kernel) << ": " << result[i] << " instead of " << expected.value
                         << " +- " << expected.tolerance;
      if (!right) return;
    }
    compared_ += result.size();
  }

  [[nodiscard]] std::size_t compared() const { return compared_; }

 private:
  /// All vertices and the lengths of the paths to them. By rings, an edge has length 1.
  void find_paths(VertexId v, VertexMask walls, Metric metric) {
    paths_from_ = v;
    PlainStart start{.center = position(mesh_, v), .seeds = {v}, .walls = std::vector<std::uint8_t>(size())};
    for (VertexId w = 0; w < size(); ++w) start.walls[w] = walls.size() != 0 && walls[w] ? 1 : 0;
    const std::vector<double> lengths = oracle_.path_lengths(start, kInfinity, [&](std::uint32_t a, std::uint32_t b) {
      return metric == Metric::Rings ? 1 : oracle_.graph().distance(a, b);
    });
    ids_.clear();
    distances_.clear();
    for (VertexId w = 0; w < size(); ++w) {
      if (lengths[w] == kInfinity) continue;
      ids_.push_back(w);
      distances_.push_back(lengths[w]);
    }
  }

  /// Of the neighborhood that was found, those that the filter leaves.
  std::vector<Item> items(const SignalView& signal, std::size_t channel, VertexId v, Metric metric, const Masks& masks,
                          double radius) {
    std::vector<Item> result;
    const auto is_in = [](VertexMask mask, VertexId w) { return mask.size() != 0 && mask[w]; };
    if (is_in(masks.walls, v)) return result;
    const bool is_straight = metric == Metric::Straight || metric == Metric::Space;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (distances_[i] > radius) continue;  // of a patch
      if (is_in(masks.ignored, ids_[i]) || is_in(masks.walls, ids_[i])) continue;
      result.push_back({signal.values[ids_[i] * signal.channels + channel],
                        signal.weights.empty() ? 1 : signal.weights[ids_[i]],
                        is_straight ? exact_distance(v, ids_[i]) : distances_[i]});
    }
    return result;
  }

  /// Squares of doubles may underflow.
  [[nodiscard]] long double exact_distance(VertexId v, VertexId w) const {
    long double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long double step = static_cast<long double>(mesh_.positions[3 * std::size_t{v} + axis]) -
                               mesh_.positions[3 * std::size_t{w} + axis];
      square += step * step;
    }
    return std::sqrt(square);
  }

  TestMesh mesh_;
  Index index_;
  RegionOracle oracle_;
  VertexId paths_from_ = 0;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
  std::size_t compared_ = 0;
};

MESHHOOD_SUITE_OF_FAMILIES(AggregateOfFamily);

TEST_P(AggregateOfFamily, EqualsTheDefinition) {
  Random random(3);
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < scaled(2, 1); ++seed) {
    AggregateCase scene(make_mesh(GetParam(), seed, 200));
    for (const bool gaps : {false, true}) {
      const TestSignal signal = make_signal(scene.size(), gaps, random);
      for (const Reduce reduce : kReductions) {
        AggregateQuery query;
        query.reduce = {reduce};
        query.quantile = random.uniform(0, 1);
        query.kernel = may_have_kernel(reduce) ? kKernels[random.below(kKernels.size())] : SmoothingKernel::Box;
        query.missing = random.below(2) == 0 ? MissingValues::Omit : MissingValues::Propagate;
        query.nesting = random.below(2) == 0 ? Nesting::Patch : Nesting::Own;
        query.radius = BatchRadius::scales({scene.radius(random), scene.radius(random)});
        const auto walls = draw_mask(random, scene.size(), random.below(2) * 8);
        const auto ignored = draw_mask(random, scene.size(), random.below(2) * 5);
        query.metric = std::array{Metric::Straight, Metric::Path, Metric::Rings, Metric::Space}[random.below(4)];
        const bool weighted = random.below(2) == 0;
        if (!weighted) query.ddof = static_cast<unsigned>(random.below(2));
        std::vector<VertexId> list;
        if (scene.size() > 0 && random.below(2) == 0) {
          for (std::size_t i = 0; i < 40; ++i) list.push_back(static_cast<VertexId>(random.below(scene.size())));
          query.vertices = list;
        }
        std::vector<double> radii;
        if (random.below(3) == 0) {
          radii.resize(list.empty() ? scene.size() : list.size());
          for (double& radius : radii) radius = scene.radius(random);
          query.radius = radii;
        }
        scene.compare(signal.view(weighted), query, {walls, ignored});
        if (HasFailure()) return;
      }
    }
    compared += scene.compared();
  }
  std::printf("%zu numbers compared\n", compared);
}

/// A bumpy grid with many leaves, so that packets have cores, whole and partial leaves.
class Aggregate : public testing::Test {
 protected:
  Random random{8};
  TestMesh mesh = bumpy_grid(60).finish(true);
  AggregateCase scene{mesh};
  TestSignal signal = make_signal(scene.size(), false, random);
  TestSignal gappy = make_signal(scene.size(), true, random);

  [[nodiscard]] std::vector<double> run(const AggregateQuery& query, unsigned threads = 1) const {
    return aggregate(scene.index(), gappy.view(false), query, {.threads = threads});
  }
};

TEST_F(Aggregate, OfLargeNeighborhoodsEqualsTheDefinition) {
  std::vector<VertexId> leaves;  // of five places in index order
  for (std::size_t i = 0; i < 5; ++i) {
    const auto place = scene.index().permutation().subspan(700 * i, scaled(30, 4));
    leaves.insert(leaves.end(), place.begin(), place.end());
  }
  for (const Nesting nesting : {Nesting::Own, Nesting::Patch}) {
    for (const Reduce reduce : kReductions) {
      for (const SmoothingKernel kernel : kKernels) {
        if (kernel != SmoothingKernel::Box && !may_have_kernel(reduce)) continue;
        const AggregateQuery query{.vertices = leaves,
                                   .radius = BatchRadius::scales({25, 9.5, 3, 60}),
                                   .reduce = {reduce},
                                   .kernel = kernel,
                                   .missing = MissingValues::Omit,
                                   .nesting = nesting,
                                   .quantile = 0.9};
        scene.compare(gappy.view(reduce != Reduce::Count), query);
      }
    }
  }
  std::printf("%zu numbers compared\n", scene.compared());
}

TEST_F(Aggregate, OfSeveralRadiiEqualsThatOfEachRadius) {
  for (const Reduce reduce : kReductions) {
    const std::vector<double> both = run({.radius = BatchRadius::scales({6, 2}), .reduce = {reduce}});
    std::vector<double> one_by_one = run({.radius = 6, .reduce = {reduce}});
    const std::vector<double> second = run({.radius = 2, .reduce = {reduce}});
    one_by_one.insert(one_by_one.end(), second.begin(), second.end());
    EXPECT_EQ(bits_of(both), bits_of(one_by_one));
  }
}

TEST_F(Aggregate, OfSeveralReductionsHasTheBitsOfEach) {
  const std::vector<Reduce> sums{Reduce::Mean, Reduce::Sum};
  const std::vector<Reduce> all(kReductions.begin(), kReductions.end());
  std::vector<VertexId> rows(scaled(scene.size(), 300));
  std::iota(rows.begin(), rows.end(), 0);
  const auto compare = [&](const SignalView& view, AggregateQuery query, const std::vector<Reduce>& reductions) {
    query.vertices = rows;
    query.reduce = reductions;
    const std::vector<std::uint64_t> together = bits_of(aggregate(scene.index(), view, query, {.threads = 2}));
    for (std::size_t k = 0; k < reductions.size(); ++k) {
      query.reduce = {reductions[k]};
      const std::vector<std::uint64_t> alone = bits_of(aggregate(scene.index(), view, query));
      ASSERT_EQ(together.size(), reductions.size() * alone.size());
      for (std::size_t i = 0; i < alone.size(); ++i) ASSERT_EQ(together[i * reductions.size() + k], alone[i]);
    }
  };
  const BatchRadius radii = BatchRadius::scales({5, 2});
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings}) {
    for (const Nesting nesting : {Nesting::Own, Nesting::Patch}) {
      for (const SmoothingKernel kernel : kKernels) {
        const AggregateQuery query{.radius = radii, .metric = metric, .kernel = kernel, .nesting = nesting};
        compare(gappy.view(true), query, kernel == SmoothingKernel::Box ? all : sums);
      }
    }
  }
  const std::vector<double> many(50 * scene.size(), 0.5);  // blocks of channels, and listed rows
  compare({many, 50}, {.radius = radii, .kernel = SmoothingKernel::Gaussian}, sums);
  compare({many, 50}, {.radius = 3}, all);
}

TEST_F(Aggregate, WithARadiusForEachRowEqualsThatOfEachRadiusToTheBit) {
  const std::vector<double> choices{0, 1.5, 4, 9.5};
  std::vector<double> radii;
  for (std::size_t v = 0; v < scene.size(); ++v) radii.push_back(choices[random.below(choices.size())]);
  for (const Metric metric : {Metric::Straight, Metric::Path, Metric::Rings, Metric::Space}) {
    for (const Reduce reduce : {Reduce::Mean, Reduce::Maximum, Reduce::StandardDeviation}) {
      for (const SmoothingKernel kernel : kKernels) {
        if (kernel != SmoothingKernel::Box && !may_have_kernel(reduce)) continue;
        AggregateQuery query{.radius = radii, .metric = metric, .reduce = {reduce}, .kernel = kernel};
        const std::vector<std::uint64_t> found = bits_of(run(query, 2));
        query.radius = BatchRadius::scales(choices);
        const std::vector<std::uint64_t> each = bits_of(run(query));
        for (std::size_t i = 0; i < found.size(); ++i) {
          const auto choice = std::ranges::find(choices, radii[i / gappy.channels]) - choices.begin();
          ASSERT_EQ(found[i], each[static_cast<std::size_t>(choice) * found.size() + i]) << "number " << i;
        }
      }
    }
  }
}

TEST_F(Aggregate, OfManyChannelsEqualsThatOfEachChannel) {
  constexpr std::size_t kChannels = 37;
  std::vector<double> values(kChannels * scene.size());
  for (double& value : values) value = random.uniform(-1, 1);
  const AggregateQuery query{.radius = 5};
  const std::vector<double> all = aggregate(scene.index(), {values, kChannels}, query);
  for (const std::size_t channel : {0U, 15U, 16U, 36U}) {
    std::vector<double> column;
    std::vector<double> expected;
    for (std::size_t v = 0; v < scene.size(); ++v) {
      column.push_back(values[v * kChannels + channel]);
      expected.push_back(all[v * kChannels + channel]);
    }
    EXPECT_EQ(aggregate(scene.index(), {column}, query), expected);
  }
}

/// A cluster far from the rest, so small that its bounding sphere, whose center is rounded, is much larger than it.
TEST(AggregateOfATinyCluster, EqualsTheDefinition) {
  TestMesh mesh = make_grid(5, 5, false);
  const auto first = static_cast<VertexId>(mesh.size());
  const double step = 0x1p-30;
  for (VertexId v = 0; v < 25; ++v) {
    const VertexId column = v % 5;
    const VertexId row = v / 5;
    mesh.add_vertex(1000.1 + step * column, 700.3 + step * row, 300.7);
  }
  for (VertexId v = 1; v < 25; ++v) mesh.add_face({first + v - 1, first + v});
  AggregateCase scene(mesh.finish(false));
  Random random(7);
  const TestSignal signal = make_signal(mesh.size(), false, random);
  for (const SmoothingKernel kernel : kKernels) {
    scene.compare(signal.view(false), {.radius = 7 * step, .reduce = {Reduce::Mean}, .kernel = kernel});
  }
}

TEST_F(Aggregate, OfAPatchWithOneRadiusIsThatOfTheNeighborhood) {
  for (const Reduce reduce : {Reduce::Minimum, Reduce::Maximum, Reduce::Count, Reduce::Median}) {
    AggregateQuery query{.radius = 7, .reduce = {reduce}};
    const auto own = bits_of(run(query));
    query.nesting = Nesting::Patch;
    EXPECT_EQ(bits_of(run(query)), own);
  }
}

TEST_F(Aggregate, ScalesWithPowersOfTwoToTheBit) {
  for (const Reduce reduce : {Reduce::Sum, Reduce::Mean, Reduce::StandardDeviation, Reduce::Maximum}) {
    const AggregateQuery query{.radius = 6, .reduce = {reduce}};
    const std::vector<double> plain = aggregate(scene.index(), signal.view(false), query);
    for (const int exponent : {-900, -500, 500, 900}) {
      TestSignal scaled_signal = signal;
      for (double& value : scaled_signal.values) value = std::ldexp(value, exponent);
      std::vector<double> expected = plain;
      for (double& value : expected) value = std::ldexp(value, exponent);
      EXPECT_EQ(bits_of(aggregate(scene.index(), scaled_signal.view(false), query)), bits_of(expected))
          << "reduction " << static_cast<int>(reduce) << ", exponent " << exponent;
    }
  }
}

TEST_F(Aggregate, OfTheLargestDoublesOverflowsOnlyWhereTheResultDoes) {
  const std::vector<double> values(scene.size(), 0x1p1023);
  const auto of = [&](Reduce reduce) { return aggregate(scene.index(), {values}, {.radius = 3, .reduce = {reduce}}); };
  EXPECT_THAT(of(Reduce::Mean), Each(0x1p1023));
  EXPECT_THAT(of(Reduce::StandardDeviation), Each(0));
  EXPECT_THAT(of(Reduce::Sum), Each(kInfinity));
}

TEST_F(Aggregate, OfInfiniteValuesFollowsIeee) {
  std::vector<double> values(scene.size(), 1.0);
  values[0] = kInfinity;
  const auto of = [&](Reduce reduce) {
    return aggregate(scene.index(), {values}, {.radius = kInfinity, .reduce = {reduce}}).front();
  };
  EXPECT_EQ(of(Reduce::Sum), kInfinity);
  EXPECT_EQ(of(Reduce::Mean), kInfinity);
  EXPECT_EQ(of(Reduce::Minimum), 1);
  EXPECT_EQ(of(Reduce::Median), 1);
  EXPECT_EQ(of(Reduce::Maximum), kInfinity);
  EXPECT_THAT(of(Reduce::Variance), IsNan());
  values[1] = -kInfinity;
  EXPECT_THAT(of(Reduce::Sum), IsNan());
}

TEST_F(Aggregate, OfMissingValuesOnlyIsNaNExceptForSumAndCount) {
  const std::vector<double> values(scene.size(), kNan);
  const auto of = [&](Reduce reduce, MissingValues missing) {
    return aggregate(scene.index(), {values}, {.radius = 3, .reduce = {reduce}, .missing = missing}).front();
  };
  for (const Reduce reduce : {Reduce::Mean, Reduce::Minimum, Reduce::Maximum, Reduce::Variance}) {
    EXPECT_THAT(of(reduce, MissingValues::Omit), IsNan());
    EXPECT_THAT(of(reduce, MissingValues::Propagate), IsNan());
  }
  EXPECT_EQ(of(Reduce::Sum, MissingValues::Omit), 0);
  EXPECT_EQ(of(Reduce::Count, MissingValues::Omit), 0);
  EXPECT_THAT(of(Reduce::Sum, MissingValues::Propagate), IsNan());
  EXPECT_GT(of(Reduce::Count, MissingValues::Propagate), 1);
}

TEST_F(Aggregate, IgnoresAHugeValueOutsideTheNeighborhood) {
  // In the same leaf as vertices of the neighborhood, so that the sums stored for the leaf include it.
  std::vector<double> values(scene.size(), 1.0);
  for (std::size_t v = 0; v < scene.size(); v += 2) values[v] = 3.0;
  values[1000] = 1e150;
  scene.compare({values}, {.radius = 2.2, .reduce = {Reduce::Variance}});
  scene.compare({values}, {.radius = 2.2, .reduce = {Reduce::Sum}});
  scene.compare({values}, {.radius = 2.2, .reduce = {Reduce::Sum}, .kernel = SmoothingKernel::Biweight});
}

TEST_F(Aggregate, OfSmallValuesDoesNotDependOnHugeOnesElsewhere) {
  const VertexId far = 1000;
  std::vector<VertexId> reached;
  Searcher(scene.index()).neighborhood(far, 4, reached);
  std::vector<double> weights(scene.size());
  for (double& weight : weights) weight = random.uniform(0.5, 2);
  for (const double huge : {1e80, 1e150, 1e300, std::numeric_limits<double>::max(), -1e299}) {
    std::vector<double> values(scene.size());
    for (double& value : values) value = random.uniform(-1, 1);
    const std::vector<double> usual = values;
    values[far] = huge;
    for (const double unit : {1e-300, 1.0, 1e300}) {
      std::vector<double> scaled_weights = weights;
      for (double& weight : scaled_weights) weight *= unit;
      scaled_weights[far] = 1;
      for (const Reduce reduce : kReductions) {
        const AggregateQuery query{.radius = 4, .reduce = {reduce}};
        const std::vector<double> found = aggregate(scene.index(), {values, 1, scaled_weights}, query);
        scaled_weights[far] = 0;  // the largest weight of the others decides their scale
        const std::vector<double> expected = aggregate(scene.index(), {usual, 1, scaled_weights}, query);
        scaled_weights[far] = 1;
        for (VertexId v = 0; v < scene.size(); ++v) {
          if (std::find(reached.begin(), reached.end(), v) != reached.end()) continue;
          EXPECT_NEAR(found[v], expected[v], 1e-12 * std::abs(expected[v]))
              << "vertex " << v << ", reduction " << static_cast<int>(reduce) << ", value " << huge << ", unit "
              << unit;
          if (HasFailure()) return;
        }
      }
    }
  }
}

/// A lattice, whose distances are exact, with a huge value at vertices at exactly the radius.
TEST(AggregateWithAKernel, GivesAVertexAtExactlyTheRadiusNoWeight) {
  constexpr VertexId kSide = 60;
  const auto [mesh, index] = indexed(make_grid(kSide, kSide, true).finish(false));
  Random random(4);
  Searcher searcher(index);
  std::vector<VertexId> ids;
  std::size_t ties = 0;
  for (const double radius : {5.0, 10.0, 13.0, 25.0}) {
    for (int round = 0; round < 20; ++round) {
      std::vector<double> values(mesh.size());
      for (double& value : values) value = random.uniform(-1, 1);
      const std::vector<VertexId> rows{static_cast<VertexId>(random.below(mesh.size()))};
      searcher.neighborhood(rows[0], radius, ids);
      const auto square = [&](VertexId v) {
        const auto dx = static_cast<std::int64_t>(v % kSide) - static_cast<std::int64_t>(rows[0] % kSide);
        const auto dy = static_cast<std::int64_t>(v / kSide) - static_cast<std::int64_t>(rows[0] / kSide);
        return static_cast<long double>(dx * dx + dy * dy);
      };
      const long double r2 = radius * radius;
      for (const VertexId v : ids) {
        if (square(v) == r2) values[v] = random.below(2) == 0 ? 1e12 : 1e300, ++ties;
      }
      for (const bool biweight : {false, true}) {
        const SmoothingKernel kernel = biweight ? SmoothingKernel::Biweight : SmoothingKernel::Epanechnikov;
        long double sum = 0;
        long double size = 0;
        for (const VertexId v : ids) {
          long double weight = (r2 - square(v)) / r2;
          if (biweight) weight *= weight;
          sum += weight * values[v];
          size += weight * std::abs(values[v]);
        }
        const double found = aggregate(
            index, {values}, {.vertices = rows, .radius = radius, .reduce = {Reduce::Sum}, .kernel = kernel})[0];
        EXPECT_NEAR(found, static_cast<double>(sum), 1e-13 * static_cast<double>(size))
            << "vertex " << rows[0] << ", radius " << radius << ", biweight " << biweight;
      }
    }
  }
  std::printf("%zu ties\n", ties);
  EXPECT_GT(ties, 0U);
}

/// On the same lattice, at each vertex.
TEST(AggregateWithAKernel, OfAnInfiniteValueIsInfiniteWhereItHasAWeight) {
  const auto [mesh, index] = indexed(make_grid(60, 60, true).finish(false));
  const std::vector<VertexId> infinite{1830};
  for (const Metric metric : {Metric::Straight, Metric::Space, Metric::Path, Metric::Rings}) {
    for (const SmoothingKernel kernel : kKernels) {
      for (const double radius : {5.0, 13.0}) {
        const Neighborhoods near =
            neighborhoods(index, {.vertices = infinite, .radius = radius, .metric = metric}, {.distances = true});
        std::vector<bool> has_weight(mesh.size());
        for (std::size_t i = 0; i < near.ids.size(); ++i) {
          has_weight[near.ids[i]] = smoothing_weight(kernel, near.distances[i], radius) > 0;
        }
        for (const double value : {kInfinity, -kInfinity}) {
          std::vector<double> values(mesh.size(), 1.0);
          values[infinite[0]] = value;
          const std::vector<double> found =
              aggregate(index, {values}, {.radius = radius, .metric = metric, .kernel = kernel});
          for (VertexId v = 0; v < mesh.size(); ++v) {
            const bool is_right = has_weight[v] ? found[v] == value : std::abs(found[v] - 1) < 1e-12;
            ASSERT_TRUE(is_right) << found[v] << ", vertex " << v << ", metric " << static_cast<int>(metric)
                                  << ", kernel " << static_cast<int>(kernel) << ", radius " << radius;
          }
        }
      }
    }
  }
}

TEST(AggregateOfFloats, IsThatOfTheSameNumbersAsDoubles) {
  const auto [mesh, index] = indexed(bumpy_grid(30));
  std::vector<float> floats;
  Random random(8);
  for (std::size_t i = 0; i < 2 * mesh.size(); ++i) floats.push_back(static_cast<float>(random.uniform(-3, 5)));
  floats[77] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> doubles(floats.begin(), floats.end());
  for (const Reduce reduce : {Reduce::Sum, Reduce::Mean, Reduce::Minimum, Reduce::Variance, Reduce::Count}) {
    const AggregateQuery query{.radius = 2.5, .reduce = {reduce}, .missing = MissingValues::Omit};
    const std::span<const float> values = floats;
    EXPECT_EQ(aggregate(index, {.values = values, .channels = 2}, query),
              aggregate(index, {.values = doubles, .channels = 2}, query));
  }
}

TEST_F(Aggregate, RefusesWrongArguments) {
  const std::vector<double> values(scene.size(), 1.0);
  const auto refuse = [&](ErrorCode code, const std::string& cause, const SignalView& given,
                          const AggregateQuery& query) {
    expect_refused(code, cause, [&] { return aggregate(scene.index(), given, query); });
  };
  const AggregateQuery query{.radius = 1};
  refuse(ErrorCode::InvalidOption, "channels is 0", {values, 0}, query);
  refuse(ErrorCode::InvalidOption, "3600 values, expected 2 for each", {values, 2}, query);
  refuse(ErrorCode::InvalidOption, "no radii", {values}, {.radius = BatchRadius::scales({})});
  refuse(ErrorCode::InvalidRadius, "radius nan", {values}, {});
  refuse(ErrorCode::InvalidRadius, "radius 1: ", {values}, {.radius = BatchRadius::scales({1, -1})});
  refuse(ErrorCode::InvalidRadius, "radius 0: ", {values}, {.radius = BatchRadius::scales({kNan})});
  const std::vector<double> short_list(3, 1.0);
  refuse(ErrorCode::InvalidRadius, "3 radii for 3600 rows", {values}, {.radius = short_list});
  refuse(ErrorCode::InvalidOption, "smoothing kernel", {values},
         {.radius = 1, .reduce = {Reduce::Minimum}, .kernel = SmoothingKernel::Biweight});
  refuse(ErrorCode::InvalidOption, "no reductions", {values}, {.radius = 1, .reduce = {}});
  for (const double bad : {-0.1, 1.5, kNan}) {
    refuse(ErrorCode::InvalidOption, "quantile is ", {values}, {.radius = 1, .quantile = bad});
  }
  refuse(ErrorCode::InvalidOption, "ddof is 2", {values}, {.radius = 1, .reduce = {Reduce::Variance}, .ddof = 2});
  std::vector<double> weights(scene.size(), 1.0);
  refuse(ErrorCode::InvalidOption, "ddof is 1 and there are weights", {values, 1, weights},
         {.radius = 1, .reduce = {Reduce::Variance}, .ddof = 1});
  for (const double bad : {-1.0, kNan, kInfinity}) {
    weights[0] = bad;
    refuse(ErrorCode::InvalidOption, "weights: vertex 0 has ", {values, 1, weights}, query);
  }
  weights.pop_back();
  refuse(ErrorCode::InvalidOption, "weights: 3599 values", {values, 1, weights}, query);
  const std::vector<VertexId> list{0, 3600};
  refuse(ErrorCode::VertexOutOfRange, "row 1", {values}, {.vertices = list, .radius = 1});
  expect_refused(ErrorCode::TooLarge, "more than 10 numbers, as many as fit into max_bytes, 80",
                 [&] { return aggregate(scene.index(), {values}, query, {.max_bytes = 80}); });
  std::vector<double> small(5);
  expect_refused(ErrorCode::InvalidOption, "room for 5 numbers",
                 [&] { aggregate(scene.index(), {values}, query, small); });
}

TEST_F(Aggregate, ReportsItsProgressAndCanBeCancelled) {
  const AggregateQuery query{.radius = BatchRadius::scales({2, 3})};
  const auto call = [&](const Progress& progress) {
    static_cast<void>(aggregate(scene.index(), signal.view(false), query, {.progress = progress}));
  };
  const Reports reports = reports_of(call);
  expect_from_nothing_to_all(reports);
  EXPECT_EQ(reports.back().second, 2 * scene.size());
  for (const std::size_t last : {0U, 1U, 2U}) expect_cancelled_at(last, call);
}

TEST_F(Aggregate, CopiesItsListsWhenTheCallBegins) {
  std::vector<VertexId> list{5, 6, 7};
  const AggregateQuery query{.vertices = list, .radius = BatchRadius::scales({2, 3, 4})};
  const std::vector<double> expected = aggregate(scene.index(), signal.view(false), query);
  const std::vector<double> result =
      aggregate(scene.index(), signal.view(false), query, {.progress = [&](std::size_t, std::size_t) {
                  list.assign({99999, 99999, 99999});
                  return true;
                }});
  EXPECT_EQ(result, expected);
}

TEST(VertexAreas, SumToTheAreaOfTheMesh) {
  for (const bool quads : {true, false}) {
    const TestMesh mesh = make_grid(4, 6, quads).finish(false);
    const std::vector<double> areas = vertex_areas(mesh.view());
    double sum = 0;
    for (const double area : areas) sum += area;
    EXPECT_DOUBLE_EQ(sum, 15);
    EXPECT_DOUBLE_EQ(areas.front(), quads ? 0.25 : 1.0 / 3);
  }
}

TEST(VertexAreas, AreRightAtAnyScaleAndInAnyPolygon) {
  for (const int exponent : {-400, 0, 400}) {
    TestMesh mesh;
    const double unit = std::ldexp(1.0, exponent);
    for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 1}, {5, 5}})
      mesh.add_vertex(x * unit, y * unit, 0);
    mesh.add_face({0, 1, 2, 3, 4});
    mesh.add_face({0, 0, 1});
    mesh.add_face({3});
    mesh.finish(false);
    const double share = std::ldexp(3.0 / 5, 2 * exponent);
    EXPECT_THAT(vertex_areas(mesh.view()), ElementsAre(share, share, share, share, share, 0)) << exponent;
  }
}

TEST(VertexAreas, DoNotDependOnAVertexFarAway) {
  for (const double far : {1e9, 1e16, 1e30, 1e90, 1e140}) {
    TestMesh mesh;
    for (const auto& [x, y] : {std::pair{0, 0}, {3, 0}, {0, 3}, {4, 2}, {1, 2}}) mesh.add_vertex(x, y, 0);
    mesh.add_vertex(far, 0, 0);
    mesh.add_face({0, 1, 2});
    mesh.add_face({0, 1, 3, 4});
    mesh.finish(false);
    EXPECT_THAT(vertex_areas(mesh.view()), ElementsAre(3, 3, 1.5, 1.5, 1.5, 0)) << far;
  }
}

}  // namespace
}  // namespace meshhood::test
