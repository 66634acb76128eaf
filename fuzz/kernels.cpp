// SPDX-License-Identifier: MIT
// Compares the kernels of every instruction set with plain loops. An input is a leaf and a ball, edges, or groups
// of nodes, with any numbers that an index may hold.
#include "simd/kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "bytes.h"
#include "judge.h"
#include "support/exact_answer.h"
#include "support/plain_kernels.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

constexpr double kLargestCoordinate = 0x1p500;  // see `validate`
constexpr double kLargestInFrame = 1e18;        // the centers of nodes that do not exist
constexpr std::size_t kLeafCoordinates = std::size_t{3} * kLeafCapacity;
constexpr std::size_t kPaddedEdges = std::size_t{3} * kLeafCapacity;

/// The next number; 0 instead of a number that no index holds.
template <class Real>
Real take_real(Bytes& bytes, double most) {
  const auto value = bytes.take<Real>();
  return std::abs(static_cast<double>(value)) <= most ? value : Real{0};
}

template <class Real>
std::array<Real, kLeafCoordinates> take_leaf(Bytes& bytes, std::size_t size) {
  std::array<Real, kLeafCoordinates> xyz{};
  xyz.fill(std::numeric_limits<Real>::quiet_NaN());  // the padding may hold anything
  for (Real& x : std::span(xyz).first(3 * size)) x = take_real<Real>(bytes, kLargestCoordinate);
  return xyz;
}

/// Any radius, or the distance `tie` of a vertex, or one of the two doubles next to it.
double take_radius(Bytes& bytes, double tie) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  switch (bytes.take<std::uint8_t>() % 4) {
    case 0: return tie;
    case 1: return std::nextafter(tie, 0.0);
    case 2: return std::nextafter(tie, kInfinity);
    default: {
      const double radius = std::abs(bytes.take<double>());
      return std::isnan(radius) ? kInfinity : radius;
    }
  }
}

template <class Real>
void compare_distances(Bytes bytes, const Kernels& tried) {
  const std::size_t size = 1 + bytes.take<std::uint8_t>() % kLeafCapacity;
  static_cast<void>(bytes.take<LaneMask>(1));  // skipped, so that the inputs of the corpus keep their meaning
  const std::size_t nearest_to = bytes.take<std::uint8_t>() % size;
  const auto xyz = take_leaf<Real>(bytes, size);
  const Point center{static_cast<double>(take_real<Real>(bytes, kLargestCoordinate)),
                     static_cast<double>(take_real<Real>(bytes, kLargestCoordinate)),
                     static_cast<double>(take_real<Real>(bytes, kLargestCoordinate))};
  const std::span<const Real> vertices(xyz);
  const double radius = take_radius(bytes, std::sqrt(squared_distance(point(vertices, nearest_to), center)));
  const LeafBall ball(center, LeafBounds(radius));

  const LaneMask inside = tried.within(xyz.data(), size, ball);
  for (std::size_t i = 0; i < size; ++i) {
    const bool expected = squared_distance(point(vertices, i), center) <= ball.squared_radius;
    if ((inside >> i & 1U) != static_cast<unsigned>(expected)) fail("within differs from the predicate");
  }
  if (size < kLeafCapacity && inside >> size != 0) fail("within returns a lane beyond the size");
}

void compare_edges(Bytes bytes, const Kernels& tried) {
  std::array<CrossEdge, kPaddedEdges> padded{};
  for (CrossEdge& edge : padded) {
    edge = {static_cast<std::uint8_t>(bytes.take<std::uint8_t>() % kLeafCapacity),
            static_cast<std::uint8_t>(bytes.take<std::uint8_t>() % kLeafCapacity)};
  }
  const auto edges = std::span<const CrossEdge>(padded).first(bytes.take<std::uint8_t>() % (2 * kLeafCapacity));
  const auto among = bytes.take<LaneMask>();
  const LaneMask from = bytes.take<LaneMask>() & among;
  const Kernels& plain = test::kPlainKernels;
  if (tried.cross_edges(edges, from) != plain.cross_edges(edges, from)) fail("cross_edges differs");

  std::array<LaneMask, kLeafCapacity> adjacency{};
  for (const CrossEdge& edge : edges) {
    adjacency[edge.from] |= LaneMask{1} << edge.to;
    adjacency[edge.to] |= LaneMask{1} << edge.from;
  }
  if (tried.reachable(adjacency.data(), among, from) != plain.reachable(adjacency.data(), among, from)) {
    fail("reachable differs");
  }

  std::array<VertexId, kLeafCapacity> ids{};
  for (VertexId& id : ids) id = bytes.take<VertexId>();
  std::array<VertexId, std::size_t{2} * kLeafCapacity> found{};
  std::array<VertexId, std::size_t{2} * kLeafCapacity> expected{};
  const auto found_end = tried.compress(ids.data(), among, found.data()) - found.data();
  const auto expected_end = plain.compress(ids.data(), among, expected.data()) - expected.data();
  if (found_end != expected_end || !std::equal(found.begin(), found.begin() + found_end, expected.begin())) {
    fail("compress differs");
  }

  std::array<double, kLeafCapacity + Kernels::kSpareNumbers> numbers{};
  for (std::size_t i = 0; i < kLeafCapacity; ++i) numbers[i] = static_cast<double>(std::bit_cast<float>(ids[i]));
  std::array<std::uint64_t, numbers.size()> found_less{};
  std::array<std::uint64_t, numbers.size()> expected_less{};
  tried.count_less(numbers.data(), kLeafCapacity, found_less.data());
  plain.count_less(numbers.data(), kLeafCapacity, expected_less.data());
  if (!std::equal(found_less.begin(), found_less.begin() + kLeafCapacity, expected_less.begin())) {
    fail("count_less differs");
  }
}

Group take_group(Bytes& bytes) {
  Group group{};
  for (Group::Row* row : {&group.x, &group.y, &group.z}) {
    for (float& value : *row) value = take_real<float>(bytes, kLargestInFrame);
  }
  for (float& radius : group.radius) radius = std::abs(take_real<float>(bytes, kLargestInFrame));
  return group;
}

void compare_groups(Bytes bytes, const Kernels& tried) {
  const std::array groups{take_group(bytes), take_group(bytes)};
  const std::array<std::uint32_t, 3> list{1, 0, 1};
  const Point center{static_cast<double>(take_real<float>(bytes, kLargestInFrame)),
                     static_cast<double>(take_real<float>(bytes, kLargestInFrame)),
                     static_cast<double>(take_real<float>(bytes, kLargestInFrame))};
  const TreeBall ball({}, center, take_radius(bytes, 1));
  std::array<GroupContainment, list.size()> found{};
  std::array<GroupContainment, list.size()> expected{};
  tried.classify(groups.data(), list, ball, found.data());
  test::kPlainKernels.classify(groups.data(), list, ball, expected.data());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (found[i].inside != expected[i].inside || found[i].intersecting != expected[i].intersecting) {
      fail("classify differs");
    }
  }

  const Group& a = groups.front();
  const Group& b = groups.back();
  BoxGroup boxes{{a.x, a.y, a.z}, {b.x, b.y, b.z}};
  const auto sort = [](BoxGroup::Row& low, BoxGroup::Row& high) {
    for (std::size_t i = 0; i < kFanOut; ++i) {
      if (low[i] > high[i]) std::swap(low[i], high[i]);
    }
  };
  sort(boxes.low.x, boxes.high.x);
  sort(boxes.low.y, boxes.high.y);
  sort(boxes.low.z, boxes.high.z);
  BoxGroup::Row squares;
  BoxGroup::Row plain_squares;
  if (tried.box_squares(boxes, Frame{}.round(center), ball.outer, squares) !=
          test::kPlainKernels.box_squares(boxes, Frame{}.round(center), ball.outer, plain_squares) ||
      squares != plain_squares) {
    fail("box_squares differs");
  }
}

}  // namespace

void run(std::span<const std::byte> input) {
  Bytes bytes(input);
  const auto kind = bytes.take<std::uint8_t>();
  for (const Isa isa : test::available_isas()) {
    const Kernels& tried = kernels(isa);
    switch (kind % 4) {
      case 0: compare_distances<float>(bytes, tried); break;
      case 1: compare_distances<double>(bytes, tried); break;
      case 2: compare_edges(bytes, tried); break;
      default: compare_groups(bytes, tried);
    }
  }
}

}  // namespace meshhood::fuzz
