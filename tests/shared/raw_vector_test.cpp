// SPDX-License-Identifier: MIT
#include "shared/raw_vector.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include <gtest/gtest.h>

namespace meshhood::test {
namespace {

// Formally, elements that were not set have any value; compilers leave what is in memory.
TEST(RawVector, LeavesNewElementsAsTheyAreInMemory) {
  RawVector<std::uint32_t> values(100, 7);
  values.clear();
  values.resize(100);  // in the same memory
  for (const std::uint32_t value : values) EXPECT_EQ(value, 7U);
}

TEST(RawVector, SetsElementsWithAValue) {
  RawVector<double> values(10, 3.0);
  values.resize(20, 5.0);
  values.push_back(8);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(values[i], 3);
  for (std::size_t i = 10; i < 20; ++i) EXPECT_EQ(values[i], 5);
  EXPECT_EQ(values[20], 8);
}

TEST(RawVector, AppendsAfterTheValues) {
  RawVector<std::uint32_t> values;
  for (std::uint32_t part = 0; part < 50; ++part) {
    const std::span<std::uint32_t> added = add_raw(values, part);
    ASSERT_EQ(added.size(), part);
    std::iota(added.begin(), added.end(), static_cast<std::uint32_t>(values.size() - part));
  }
  ASSERT_EQ(values.size(), 50U * 49 / 2);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], i);
}

TEST(RawVector, IsMovedCopiedAndComparedAsOtherVectors) {
  RawVector<int> values{1, 2, 3};
  const RawVector<int> copy = values;
  const int* const at = values.data();
  const RawVector<int> moved = std::move(values);
  EXPECT_EQ(moved.data(), at);
  EXPECT_EQ(moved, copy);
  EXPECT_NE(copy.data(), at);
}

}  // namespace
}  // namespace meshhood::test
