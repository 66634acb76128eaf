// SPDX-License-Identifier: MIT
// The order of paths by length, against `std::sort`.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "exact/query/path_search.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

using Limits = std::numeric_limits<double>;

void expect_sorted(const std::vector<double>& lengths) {
  std::vector<Path> paths;
  for (const double length : lengths) paths.push_back({length, static_cast<std::uint32_t>(paths.size() * 7 % 64)});
  PathOrder order;
  const auto expect = [](std::span<const Path> sorted, std::vector<Path> expected) {
    std::sort(expected.begin(), expected.end(),
              [](const Path& a, const Path& b) { return a.length != b.length ? a.length < b.length : a.end < b.end; });
    ASSERT_EQ(sorted.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(sorted[i].length, expected[i].length) << "path " << i;
      ASSERT_EQ(sorted[i].end, expected[i].end) << "path " << i;
    }
  };
  expect(order.sorted(paths), paths);
  const Path shortest{0, 30};
  std::vector<Path> all = paths;
  all.push_back(shortest);
  expect(order.sorted(shortest, paths), all);
}

TEST(PathOrder, SortsByLengthThenByVertex) {
  Random random(1);
  for (const std::size_t count : {0U, 1U, 2U, 64U, 96U, 97U, 5000U}) {
    for (const double unit : {0.0, Limits::denorm_min(), 1e-300, 1.0, 1e300}) {
      std::vector<double> even(count);
      for (double& length : even) length = unit * random.uniform(0, 8);
      expect_sorted(even);
      for (double& length : even) length = std::floor(length);
      expect_sorted(even);
    }
  }
}

TEST(PathOrder, SortsLengthsThatLieInOneInterval) {
  Random random(2);
  std::vector<double> lengths(3000);
  for (double& length : lengths) length = random.uniform(0, 1);
  lengths.push_back(Limits::max());
  expect_sorted(lengths);
}

}  // namespace
}  // namespace meshhood::test
