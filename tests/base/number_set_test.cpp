// SPDX-License-Identifier: MIT
// Sets of numbers against std::set.
#include "base/number_set.h"

#include <cstddef>
#include <ranges>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

std::vector<std::size_t> taken(NumberSet& set) {
  std::vector<std::size_t> numbers;
  set.take_all([&](std::size_t number) { numbers.push_back(number); });
  return numbers;
}

TEST(NumberSet, ListsItsNumbersOnceAscendingAndIsEmptyThen) {
  Random random(2);
  for (const std::size_t bound : {1U, 63U, 64U, 65U, 4095U, 4096U, 4097U, 8192U, 300'000U}) {
    NumberSet set(bound);
    for (int round = 0; round < 20; ++round) {
      std::set<std::size_t> expected{bound - 1};
      set.insert(bound - 1);
      for (int i = 0; i < 60; ++i) {
        const std::size_t number = random.below(bound);
        set.insert(number);
        expected.insert(number);
      }
      ASSERT_THAT(taken(set), testing::ElementsAreArray(expected)) << bound;
      ASSERT_THAT(taken(set), testing::IsEmpty()) << bound;
    }
  }
}

TEST(NumberSet, HasEveryNumberBelowItsBound) {
  constexpr std::size_t kBound = 2 * 4096 + 130;
  NumberSet set(kBound);
  std::vector<std::size_t> all;
  for (std::size_t number = 0; number < kBound; ++number) all.push_back(number);
  for (const std::size_t number : std::views::reverse(all)) set.insert(number);
  EXPECT_EQ(taken(set), all);
}

TEST(NumberSet, ListsItsWords) {
  NumberSet set(10'000);
  for (const std::size_t number : {1U, 63U, 64U, 4096U, 9999U}) set.insert(number);
  std::vector<std::size_t> numbers;
  set.take_words([&](std::size_t first, std::uint64_t bits) {
    EXPECT_EQ(first % 64, 0U);
    EXPECT_NE(bits, 0U);
    for (std::size_t i = 0; i < 64; ++i) {
      if ((bits >> i & 1U) != 0) numbers.push_back(first + i);
    }
  });
  EXPECT_THAT(numbers, testing::ElementsAre(1, 63, 64, 4096, 9999));
  EXPECT_THAT(taken(set), testing::IsEmpty());
}

TEST(NumberSet, IsEmptyOnceCleared) {
  NumberSet set(10'000);
  for (const std::size_t number : {0U, 63U, 64U, 4096U, 9999U}) set.insert(number);
  set.clear();
  EXPECT_THAT(taken(set), testing::IsEmpty());
  set.insert(5000);
  EXPECT_THAT(taken(set), testing::ElementsAre(5000));
}

}  // namespace
}  // namespace meshhood::test
