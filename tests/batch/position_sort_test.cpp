// SPDX-License-Identifier: MIT
// Rows are sorted by position as the standard library sorts them.
#include "batch/position_sort.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

using Row = std::pair<std::uint32_t, std::size_t>;

std::uint32_t position_of(const Row& row) { return row.first; }

/// Rows numbered in order, at random positions below `bound`.
std::vector<Row> random_rows(Random& random, std::size_t count, std::uint64_t bound) {
  std::vector<Row> rows;
  rows.reserve(count);
  for (std::size_t row = 0; row < count; ++row) {
    rows.emplace_back(static_cast<std::uint32_t>(random.below(bound)), row);
  }
  return rows;
}

TEST(PositionSort, PositionsAscendAndRowsOfOnePositionKeepTheirOrder) {
  Random random(31);
  std::size_t lists = 0;
  for (unsigned bits = 0; bits <= 32; ++bits) {
    for (const std::size_t count : {0U, 1U, 2U, 100U, 5000U}) {
      std::vector<Row> rows = random_rows(random, count, std::uint64_t{1} << bits);
      std::vector<Row> expected = rows;
      std::sort(expected.begin(), expected.end());  // ties by the number of the row
      sort_by_position(std::span(rows), position_of);
      ASSERT_EQ(rows, expected) << bits << " bits, " << count << " rows";
      ++lists;
    }
  }
  std::printf("%zu lists of rows\n", lists);
}

/// The sort agrees with that of the standard library.
void expect_sorted(const std::vector<std::uint32_t>& positions) {
  std::vector<Row> rows;
  rows.reserve(positions.size());
  for (const std::uint32_t position : positions) rows.emplace_back(position, rows.size());
  std::vector<Row> expected = rows;
  std::sort(expected.begin(), expected.end());
  sort_by_position(std::span(rows), position_of);
  ASSERT_EQ(rows, expected);
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
  std::vector<Row> rows{{kLargest, 0}, {0, 1}, {kLargest - 1, 2}, {kLargest, 3}, {1U << 31U, 4}};
  sort_by_position(std::span(rows), position_of);
  EXPECT_EQ(rows, (std::vector<Row>{{0, 1}, {1U << 31U, 4}, {kLargest - 1, 2}, {kLargest, 0}, {kLargest, 3}}));
}

}  // namespace
}  // namespace meshhood::test
