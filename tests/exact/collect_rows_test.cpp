// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/run.h"

#include "base/lists.h"

namespace meshhood::test {
namespace {

/// Row `i` has i % 7 values, some of them none.
void append(std::size_t row, std::vector<std::uint32_t>& out) {
  for (std::size_t i = 0; i < row % 7; ++i) out.push_back(static_cast<std::uint32_t>(100 * row + i));
}

TEST(CollectRows, AreInOrderWhateverTheNumberOfThreads) {
  for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 1000U}) {
    for (const unsigned threads : {1U, 2U, 5U}) {
      TaskContext task(threads);
      const auto rows = collect_rows<std::uint32_t>(count, task, append);
      ASSERT_EQ(rows.size(), count);
      std::size_t all = 0;
      for (std::size_t row = 0; row < count; ++row) {
        std::vector<std::uint32_t> expected;
        append(row, expected);
        EXPECT_EQ(std::vector<std::uint32_t>(rows[row].begin(), rows[row].end()), expected);
        all += expected.size();
      }
      EXPECT_EQ(rows.elements.size(), all);
    }
  }
}

TEST(CollectRows, PassOnWhatARowThrows) {
  TaskContext task(3);
  const auto fail = [](std::size_t row, std::vector<int>& out) {
    if (row == 700) throw std::runtime_error("row 700");
    out.push_back(0);
  };
  EXPECT_THROW(static_cast<void>(collect_rows<int>(1000, task, fail)), std::runtime_error);
}

}  // namespace
}  // namespace meshhood::test
