// SPDX-License-Identifier: MIT
// The queue of path searches, against a sorted container.
#include "exact/query/radix_heap.h"

#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

struct Item {
  double length;
  std::uint32_t number;
};

TEST(RadixHeap, TakesTheLeastWhileItemsNotBelowItArePushed) {
  Random random(1);
  RadixHeap<Item> queue;
  for (int round = 0; round < 200; ++round) {
    // Whole numbers meet often; differences of 1e-300 are lost beside 1.
    const double unit = std::vector{1e-300, 0.37, 1.0, 1e300}[random.below(4)];
    const bool is_whole = random.below(2) == 0;
    std::multiset<double> expected;
    std::multiset<std::uint32_t> numbers;
    double last = 0;
    std::uint32_t pushed = 0;
    for (int step = 0; step < 400; ++step) {
      for (std::size_t i = random.below(step < 200 ? 4 : 2); i > 0; --i) {
        const double by = is_whole ? static_cast<double>(random.below(3)) : random.uniform(0, 2);
        const Item item{last + unit * by, pushed++};
        queue.push(item);
        expected.insert(item.length);
        numbers.insert(item.number);
      }
      ASSERT_EQ(queue.empty(), expected.empty());
      if (expected.empty()) continue;
      const Item item = queue.pop();
      ASSERT_EQ(item.length, *expected.begin());
      expected.erase(expected.begin());
      ASSERT_EQ(numbers.erase(item.number), 1U);
      last = item.length;
    }
    queue.clear();
    EXPECT_TRUE(queue.empty());
  }
}

TEST(RadixHeap, TakesTheSmallestAndTheLargestLengths) {
  using Limits = std::numeric_limits<double>;
  RadixHeap<Item> queue;
  const std::vector<double> lengths{0.0, Limits::denorm_min(), Limits::min(), 1.0, Limits::max(), Limits::infinity()};
  for (auto it = lengths.rbegin(); it != lengths.rend(); ++it) queue.push({*it, 0});
  for (const double length : lengths) EXPECT_EQ(queue.pop().length, length);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace meshhood::test
