// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/error.h"

#include "support/refusal.h"

namespace meshhood::test {

/// What a call reports of its progress: what is done, and the total.
using Reports = std::vector<std::pair<std::size_t, std::size_t>>;

/// The reports of `call(progress)`, which come on the calling thread.
template <class F>
[[nodiscard]] Reports reports_of(F&& call) {
  Reports reports;
  const auto caller = std::this_thread::get_id();
  call([&](std::size_t done, std::size_t total) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    reports.emplace_back(done, total);
    return true;
  });
  return reports;
}

/// Expects at least `fewest` reports that ascend from 0 to a total, which stays the same.
inline void expect_from_nothing_to_all(const Reports& reports, std::size_t fewest = 2) {
  ASSERT_GE(reports.size(), fewest);
  EXPECT_EQ(reports.front().first, 0U);
  EXPECT_EQ(reports.back().first, reports.back().second);
  EXPECT_GT(reports.back().second, 0U);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  for (const auto& [done, total] : reports) EXPECT_EQ(total, reports.back().second);
}

/// Expects that `call(progress)` is cancelled at report `last`, counted from 0.
template <class F>
void expect_cancelled_at(std::size_t last, F&& call) {
  std::size_t reports = 0;
  expect_refused(ErrorCode::Cancelled, "cancelled",
                 [&] { call([&](std::size_t, std::size_t) { return reports++ < last; }); });
  EXPECT_EQ(reports, last + 1);
}

}  // namespace meshhood::test
