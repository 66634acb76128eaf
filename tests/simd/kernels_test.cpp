// SPDX-License-Identifier: MIT
// Every instruction set gives the same bits, also where single precision cannot decide.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/kernel_target.h"

#include "support/exact_answer.h"
#include "support/plain_kernels.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class EveryIsa : public testing::TestWithParam<Isa> {
 protected:
  const Kernels& tried = kernels(GetParam());
  const Kernels& plain = kPlainKernels;
  Random random{9};
};

/// A leaf of `size` vertices, followed by padding.
template <class Real>
std::vector<Real> random_leaf(Random& random, std::size_t size, double extent) {
  std::vector<Real> xyz(3 * kLeafCapacity, std::numeric_limits<Real>::quiet_NaN());
  for (std::size_t i = 0; i < 3 * size; ++i) xyz[i] = static_cast<Real>(random.uniform(-extent, extent));
  return xyz;
}

/// `value` rounded to the precision of the coordinates. Goes through memory, because g++ 12 drops several such
/// roundings side by side.
template <class Real>
double rounded(double value) {
  const volatile Real result = static_cast<Real>(value);
  return static_cast<double>(result);
}

/// The result of the predicate.
template <class Real>
LaneMask by_predicate(const std::vector<Real>& xyz, std::size_t size, const Point& center, double radius) {
  const SearchBall ball(center, radius);
  LaneMask lanes = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point p = point(std::span(xyz), i);
    lanes |= LaneMask{ball.contains(p)} << i;
  }
  return lanes;
}

template <class Real>
void expect_within_is_the_predicate(const Kernels& tried, Random& random) {
  std::size_t balls = 0;
  for (std::size_t round = 0; round < scaled(4000, 100); ++round) {
    const std::size_t size = 1 + random.below(kLeafCapacity);
    const double extent = std::ldexp(1.0, static_cast<int>(random.below(120)) - 60);
    const auto xyz = random_leaf<Real>(random, size, extent);
    const Point center{rounded<Real>(random.uniform(-extent, extent)), rounded<Real>(random.uniform(-extent, extent)),
                       rounded<Real>(random.uniform(-extent, extent))};
    const std::size_t lane = random.below(size);
    const Point p = point(std::span(xyz), lane);
    const double tie = std::sqrt(squared_distance(p, center));
    for (const double radius : {std::nextafter(tie, 0.0), tie, std::nextafter(tie, 1e300), tie * (1 + 1e-7),
                                tie * (1 - 1e-7), random.uniform(0, 3 * extent), 0.0}) {
      const LeafBall ball(center, LeafBounds(radius));
      const LaneMask inside = by_predicate(xyz, size, center, radius);
      ASSERT_EQ(tried.within(xyz.data(), size, ball), inside);
      PerLane<double> squares{};
      ASSERT_EQ(tried.squares(xyz.data(), size, ball, squares), inside);
      for (std::size_t i = 0; i < size; ++i) {
        ASSERT_EQ(squares[i], squared_distance(point(std::span(xyz), i), center));
      }
      ++balls;
    }
  }
  std::printf("%zu balls\n", balls);
}

TEST_P(EveryIsa, WithinIsThePredicateOnFloats) { expect_within_is_the_predicate<float>(tried, random); }
TEST_P(EveryIsa, WithinIsThePredicateOnDoubles) { expect_within_is_the_predicate<double>(tried, random); }

TEST_P(EveryIsa, CrossEdgesReturnsTheOtherEndsOfTheEdges) {
  for (std::size_t round = 0; round < 4000; ++round) {
    std::vector<CrossEdge> cross_edges(random.below(70) + kLeafCapacity);
    for (CrossEdge& cross_edge : cross_edges) {
      cross_edge = {static_cast<std::uint8_t>(random.below(32)), static_cast<std::uint8_t>(random.below(32))};
    }
    const std::size_t count = cross_edges.size() - kLeafCapacity;
    const auto from = static_cast<LaneMask>(random.bits() & random.bits());
    const auto edges = std::span<const CrossEdge>(cross_edges).first(count);
    ASSERT_EQ(tried.cross_edges(edges, from), plain.cross_edges(edges, from));
  }
}

TEST_P(EveryIsa, ReachableFindsAllConnectedLanes) {
  std::size_t grown = 0;
  for (std::size_t round = 0; round < 4000; ++round) {
    std::vector<LaneMask> adjacency(kLeafCapacity);
    const std::size_t edges = random.below(60);
    for (std::size_t i = 0; i < edges; ++i) {
      const std::size_t a = random.below(kLeafCapacity);
      const std::size_t b = random.below(kLeafCapacity);
      adjacency[a] |= LaneMask{1} << b;
      adjacency[b] |= LaneMask{1} << a;
    }
    const auto among = static_cast<LaneMask>(random.bits() | random.bits());
    const auto from = static_cast<LaneMask>(random.bits() & random.bits() & random.bits()) & among;
    const LaneMask reached = tried.reachable(adjacency.data(), among, from);
    ASSERT_EQ(reached, plain.reachable(adjacency.data(), among, from));
    ASSERT_EQ(reached & among, reached);
    grown += static_cast<std::size_t>(std::popcount(reached & ~from));
  }
  EXPECT_GT(grown, 10'000U);
}

TEST_P(EveryIsa, ClassifyComparesAllEightNodes) {
  std::vector<Group> groups(64);
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < groups.size(); ++i) list.push_back(i);
  std::vector<GroupContainment> expected(groups.size());
  std::vector<GroupContainment> found(groups.size());
  std::size_t seen = 0;
  for (std::size_t round = 0; round < 300; ++round) {
    for (Group& group : groups) {
      for (Group::Row* row : {&group.x, &group.y, &group.z, &group.radius}) {
        for (float& value : *row) value = static_cast<float>(random.uniform(-1, 1));
      }
      for (float& radius : group.radius) radius = std::abs(radius) / 4;
    }
    const Point center{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double radius = round == 0 ? std::numeric_limits<double>::infinity() : random.uniform(0, 2);
    const TreeBall ball({}, center, radius);
    plain.classify(groups.data(), list, ball, expected.data());
    tried.classify(groups.data(), list, ball, found.data());
    for (std::size_t i = 0; i < groups.size(); ++i) {
      ASSERT_EQ(found[i].inside, expected[i].inside);
      ASSERT_EQ(found[i].intersecting, expected[i].intersecting);
      ASSERT_EQ(found[i].inside & found[i].intersecting, 0);
      seen += static_cast<std::size_t>(std::popcount(found[i].inside));
    }
  }
  EXPECT_GT(seen, 1000U);
}

TEST_P(EveryIsa, BoxSquaresMeasuresAllEightBoxes) {
  std::size_t inside = 0;
  for (std::size_t round = 0; round < 4000; ++round) {
    BoxGroup boxes;
    const auto fill = [&](BoxGroup::Row& low, BoxGroup::Row& high) {
      for (std::size_t i = 0; i < kFanOut; ++i) {
        low[i] = static_cast<float>(random.uniform(-1, 1));
        high[i] = low[i] + static_cast<float>(random.uniform(0, 1));
      }
    };
    fill(boxes.low.x, boxes.high.x);
    fill(boxes.low.y, boxes.high.y);
    fill(boxes.low.z, boxes.high.z);
    const Point p{random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2)};
    const FramePoint center = Frame{}.round(p);
    const auto limit = static_cast<float>(random.uniform(0, 3));
    BoxGroup::Row found;
    BoxGroup::Row expected;
    const unsigned near = tried.box_squares(boxes, center, limit, found);
    ASSERT_EQ(near, plain.box_squares(boxes, center, limit, expected));
    for (std::size_t i = 0; i < kFanOut; ++i) {
      ASSERT_EQ(expected[i], found[i]);
      ASSERT_EQ((near >> i & 1U) != 0, found[i] <= limit);
      inside += static_cast<std::size_t>(found[i] == 0);
    }
  }
  EXPECT_GT(inside, 100U);
}

TEST_P(EveryIsa, BoxEntriesMeetsAllEightBoxes) {
  std::size_t met = 0;
  for (std::size_t round = 0; round < 4000; ++round) {
    BoxGroup boxes;
    for (BoxGroup::Row* row : {&boxes.low.x, &boxes.low.y, &boxes.low.z}) {
      for (float& value : *row) value = static_cast<float>(random.uniform(-1, 1));
    }
    boxes.high = boxes.low;
    for (BoxGroup::Row* row : {&boxes.high.x, &boxes.high.y, &boxes.high.z}) {
      for (float& value : *row) value += static_cast<float>(random.uniform(0, 1));
    }
    const auto axis = [&] {
      const auto from = static_cast<float>(random.uniform(-1, 1));
      const auto along = static_cast<float>(random.uniform(-1, 1));
      return BoxRay::Axis{from, from, 1 / along};
    };
    const BoxRay ray{axis(), axis(), axis()};
    const auto limit = static_cast<float>(random.uniform(0, 3));
    BoxGroup::Row found;
    BoxGroup::Row expected;
    const unsigned bits = tried.box_entries(boxes, ray, limit, found);
    ASSERT_EQ(bits, plain.box_entries(boxes, ray, limit, expected));
    for (std::size_t i = 0; i < kFanOut; ++i) ASSERT_EQ(expected[i], found[i]);
    met += static_cast<std::size_t>(std::popcount(bits));
  }
  EXPECT_GT(met, 500U);
}

TEST_P(EveryIsa, CompressKeepsTheOrder) {
  std::vector<VertexId> ids(kLeafCapacity);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<VertexId>(100 + i);
  std::vector<VertexId> out(std::size_t{2} * kLeafCapacity);
  for (std::size_t round = 0; round < 10'000; ++round) {
    const auto lanes = static_cast<LaneMask>(round == 0 ? 0 : random.bits());
    const VertexId* const end = tried.compress(ids.data(), lanes, out.data());
    ASSERT_EQ(end - out.data(), std::popcount(lanes));
    const VertexId* next = out.data();
    for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
      if ((lanes >> lane & 1U) == 0) continue;
      ASSERT_EQ(*next++, 100 + lane);
    }
  }
}

TEST_P(EveryIsa, CountLessComparesEachWithEach) {
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  for (std::size_t round = 0; round < scaled(4000, 100); ++round) {
    const std::size_t count = random.below(100);
    const double step = round % 3 == 0 ? kTiny : random.uniform(0, 1e300);  // few steps, so that some are equal
    std::vector<double> numbers(count + Kernels::kSpareNumbers, std::numeric_limits<double>::quiet_NaN());
    const std::size_t most = round % 2 == 0 ? 9 : 1000;
    for (std::size_t i = 0; i < count; ++i) numbers[i] = step * static_cast<double>(random.below(most));
    std::vector<std::uint64_t> found(numbers.size());
    std::vector<std::uint64_t> expected(count);
    tried.count_less(numbers.data(), count, found.data());
    plain.count_less(numbers.data(), count, expected.data());
    found.resize(count);
    ASSERT_EQ(found, expected);
  }
}

TEST(KernelTarget, IsTheLimitOfTheKernels) {
  const Isa best = best_isa();
  EXPECT_EQ(kernel_target(), name_of(best));
  limit_isa(Isa{});
  EXPECT_EQ(kernel_target(), name_of(Isa{}));
  limit_isa(best);
}

std::string case_name(const testing::TestParamInfo<Isa>& isa) { return name_of(isa.param); }

INSTANTIATE_TEST_SUITE_P(Isas, EveryIsa, testing::ValuesIn(available_isas()), case_name);

}  // namespace
}  // namespace meshhood::test
