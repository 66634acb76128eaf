// SPDX-License-Identifier: MIT
#include "shared/helper_threads.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace meshhood::test {
namespace {

constexpr std::size_t kMost = 7;

/// A loop that does not end before all threads take part in it.
void meet(HelperThreads& helpers) {
  std::atomic<std::size_t> arrived{0};
  helpers.run(kMost, [&](unsigned) {
    ++arrived;
    while (arrived <= kMost) std::this_thread::yield();
  });
  ASSERT_EQ(arrived, kMost + 1);
}

TEST(HelperThreads, CallEachNumberAtMostOnceInALoop) {
  HelperThreads helpers;
  // More threads, then fewer, then more again.
  for (const std::size_t most : {2U, 1U, 7U, 3U, 7U, 0U, 4U}) {
    for (int loop = 0; loop < 200; ++loop) {
      std::array<std::atomic<int>, kMost + 1> calls{};
      helpers.run(most, [&](unsigned thread) {
        ASSERT_LE(thread, most);
        ++calls[thread];
      });
      ASSERT_EQ(calls[0], 1);
      for (const std::atomic<int>& count : calls) ASSERT_LE(count, 1);
    }
  }
}

TEST(HelperThreads, TakePartInLoopsThatWaitForThem) {
  HelperThreads helpers;
  for (int loop = 0; loop < 100; ++loop) meet(helpers);
}

TEST(HelperThreads, HaveEndedWhenALoopReturns) {
  HelperThreads helpers;
  for (int loop = 0; loop < 300; ++loop) {
    std::vector<int> written(kMost + 1);  // freed at the end of the loop
    std::atomic<int> left{1000};
    helpers.run(kMost, [&](unsigned thread) {
      while (left.fetch_sub(1) > 0) ++written[thread];
    });
    int sum = 0;
    for (const int count : written) sum += count;
    ASSERT_EQ(sum, 1000);
  }
}

TEST(HelperThreads, SleepAndWakeBetweenLoops) {
  HelperThreads helpers;
  for (int loop = 0; loop < 5; ++loop) {
    meet(helpers);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace
}  // namespace meshhood::test
