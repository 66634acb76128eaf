// SPDX-License-Identifier: MIT
#include "base/kd_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "shared/parallel.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kUnit = 8;

/// On a lattice, so that coordinates are equal.
std::vector<KdPoint> lattice_points(std::size_t count) {
  Random random(count);
  const auto coordinate = [&] { return static_cast<float>(random.below(20)); };
  std::vector<KdPoint> points;
  for (std::uint32_t id = 0; id < count; ++id) points.push_back({{coordinate(), 2 * coordinate(), coordinate()}, id});
  return points;
}

std::size_t widest_axis(std::span<const KdPoint> points) {
  std::array<float, 3> width{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::ranges::minmax_element(points, {}, [&](const KdPoint& p) { return p.at[axis]; });
    width[axis] = high->at[axis] - low->at[axis];
  }
  return static_cast<std::size_t>(std::ranges::max_element(width) - width.begin());
}

/// The order by its definition.
void plain_order(std::span<KdPoint> points, KdCut where) {
  if (points.size() <= kUnit) {
    std::ranges::sort(points, {}, &KdPoint::id);
    return;
  }
  const std::size_t axis = widest_axis(points);
  std::ranges::sort(points, {}, [&](const KdPoint& p) { return std::tuple(p.at[axis], p.id); });
  const std::size_t units = (points.size() + kUnit - 1) / kUnit;
  std::size_t before = units / 2;
  if (where == KdCut::Power) {
    for (before = 1; 2 * before < units;) before *= 2;
  }
  plain_order(points.first(before * kUnit), where);
  plain_order(points.subspan(before * kUnit), where);
}

TEST(KdOrder, IsThatOfItsDefinitionOnAnyNumberOfThreads) {
  for (const std::size_t count : {0, 1, 7, 8, 9, 16, 17, 40, 64, 65, 513, 3000, 10001}) {
    for (const KdCut where : {KdCut::Middle, KdCut::Power}) {
      std::vector<KdPoint> expected = lattice_points(count);
      plain_order(expected, where);
      for (const unsigned threads : {1U, 2U, 7U}) {
        std::vector<KdPoint> points = lattice_points(count);
        TaskContext task(threads);
        kd_order(points, kUnit, task, where);
        EXPECT_TRUE(std::ranges::equal(points, expected, {}, &KdPoint::id, &KdPoint::id))
            << count << " points, " << threads << " threads, by power: " << (where == KdCut::Power);
      }
    }
  }
}

}  // namespace
}  // namespace meshhood::test
