// SPDX-License-Identifier: MIT
// Rows are sorted by position as the standard library sorts them.
#include "batch/position_sort.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

using Rows = RawVector<std::uint64_t>;

/// Rows numbered in order, at the given positions.
Rows rows_at(const std::vector<std::uint32_t>& positions) {
  Rows rows;
  for (const std::uint64_t position : positions) rows.push_back((position << 32) + rows.size());
  return rows;
}

/// The sort agrees with that of the standard library, on any number of threads.
void expect_sorted(const std::vector<std::uint32_t>& positions) {
  Rows expected = rows_at(positions);
  std::ranges::sort(expected);  // ties by the number of the row
  for (const unsigned threads : {1U, 3U}) {
    TaskContext task(threads);
    Rows rows = rows_at(positions);
    sort_by_position(rows, task);
    ASSERT_EQ(rows, expected) << positions.size() << " rows, " << threads << " threads";
  }
}

TEST(PositionSort, PositionsAscendAndRowsOfOnePositionKeepTheirOrder) {
  Random random(31);
  std::size_t lists = 0;
  for (unsigned bits = 0; bits <= 32; ++bits) {
    for (const std::size_t count : {0U, 1U, 2U, 100U, 5000U, 70000U}) {
      std::vector<std::uint32_t> positions(count);
      for (std::uint32_t& position : positions) {
        position = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << bits));
      }
      expect_sorted(positions);
      ++lists;
    }
  }
  std::printf("%zu lists of rows\n", lists);
}

TEST(PositionSort, ExtremeLists) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  for (const std::size_t count : {2U, 2047U, 2048U, 2049U}) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      const std::uint32_t digit = 1U << bit;
      std::vector<std::uint32_t> positions(count, digit);
      expect_sorted(positions);
      positions.back() = digit - 1;  // all others are sorted
      expect_sorted(positions);
      positions.front() = kLargest;
      expect_sorted(positions);
      for (std::size_t i = 0; i < count; ++i) positions[i] = i % 2 == 0 ? kLargest : kLargest - digit;
      expect_sorted(positions);
      for (std::size_t i = 0; i < count; ++i) positions[i] = static_cast<std::uint32_t>(kLargest - i * digit);
      expect_sorted(positions);
    }
  }
}

TEST(PositionSort, TheLargestPositionsAreSortedToo) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  expect_sorted({kLargest, 0, kLargest - 1, kLargest, 1U << 31U});
}

}  // namespace
}  // namespace meshhood::test
