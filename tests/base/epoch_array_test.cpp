// SPDX-License-Identifier: MIT
#include "base/epoch_array.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

constexpr std::uint32_t kLastEpoch = std::numeric_limits<std::uint32_t>::max();

TEST(EpochArray, KnowsWhatWasSetSinceTheLastForget) {
  EpochArray<int> array(100);
  ASSERT_EQ(array.size(), 100U);
  Random random(1);
  std::size_t known = 0;
  for (int search = 0; search < 200; ++search) {
    array.forget();
    std::map<std::size_t, int> expected;
    for (int i = 0; i < 30; ++i) {
      const std::size_t at = random.below(100);
      const int value = static_cast<int>(random.below(1000));
      EXPECT_EQ(array.set(at, value), value);
      expected[at] = value;
      ++array[at];
      ++expected[at];
    }
    for (std::size_t i = 0; i < 100; ++i) {
      ASSERT_EQ(array.is_known(i), expected.contains(i)) << i;
      if (!array.is_known(i)) continue;
      ASSERT_EQ(array[i], expected[i]);
      ++known;
    }
  }
  EXPECT_GT(known, 1000U);
}

// The numbers of the searches run out after 2^32 of them. What earlier ones have set must not become known again, nor
// what none has set.
TEST(EpochArray, ForgetsEverythingWhenTheEpochsRunOut) {
  EpochArray<int> array(3);
  array.forget();
  array.set(0, 7);  // in the first epoch, which comes again
  array.set_epoch(kLastEpoch - 1);
  array.forget();
  array.set(1, 8);
  EXPECT_TRUE(array.is_known(1));
  for (int search = 0; search < 3; ++search) {
    array.forget();
    for (std::size_t i = 0; i < 3; ++i) ASSERT_FALSE(array.is_known(i)) << i << ", search " << search;
  }
  array.set(2, 9);
  EXPECT_TRUE(array.is_known(2));
  EXPECT_FALSE(array.is_known(0));
}

TEST(EpochSet, IsEmptyAfterEachForgetAndWhenItsNumbersRunOut) {
  EpochSet set(3);
  set.add(1);
  for (std::size_t search = 0; search < 2 * 65536; ++search) {
    ASSERT_EQ(set.has(1), search == 0) << search;
    set.forget();
    set.add(2);
    ASSERT_TRUE(set.has(2) && !set.has(0) && !set.has(1)) << search;
  }
}

}  // namespace
}  // namespace meshhood::test
