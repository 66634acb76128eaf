// SPDX-License-Identifier: MIT
#include "shared/helper_threads.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <set>
#include <thread>
#include <vector>

#if defined(__linux__) && !defined(__ANDROID__)
#include <pthread.h>
#include <sched.h>
#endif

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

#if defined(__STDCPP_THREADS__) && defined(__linux__) && !defined(__ANDROID__)
/// The processors that a thread may use; none if the system does not tell.
std::set<int> processors() {
  cpu_set_t mask;
  std::set<int> all;
  if (pthread_getaffinity_np(pthread_self(), sizeof(mask), &mask) != 0) return all;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(static_cast<std::size_t>(i), &mask)) all.insert(i);
  }
  return all;
}

/// Those of the helpers of a loop in which all take part.
std::vector<std::set<int>> processors_of_helpers(HelperThreads& helpers, std::size_t helping) {
  std::atomic<std::size_t> arrived{0};
  std::vector<std::set<int>> found(helping + 1);
  helpers.run(helping, [&](unsigned thread) {
    ++arrived;
    while (arrived <= helping) std::this_thread::yield();
    found[thread] = processors();
  });
  found.erase(found.begin());
  return found;
}

TEST(HelperThreads, KeepOffTheProcessorOfTheCallerIfThereIsAnotherForEach) {
  const std::set<int> all = processors();
  cpu_set_t mask;
  if (all.size() < 2 || pthread_getaffinity_np(pthread_self(), sizeof(mask), &mask) != 0 ||
      pthread_setaffinity_np(pthread_self(), sizeof(mask), &mask) != 0) {
    GTEST_SKIP() << "there is one processor, or the system does not let threads choose";
  }
  for (const int mine : {*all.begin(), *all.rbegin()}) {
    cpu_set_t alone;
    CPU_ZERO(&alone);
    CPU_SET(static_cast<std::size_t>(mine), &alone);
    HelperThreads helpers;
    ASSERT_EQ(pthread_setaffinity_np(pthread_self(), sizeof(alone), &alone), 0);  // so that it is known where this runs
    EXPECT_EQ(processors_of_helpers(helpers, 1).front(), std::set<int>{mine}) << "there is no other";
    ASSERT_EQ(pthread_setaffinity_np(pthread_self(), sizeof(mask), &mask), 0);
  }
  HelperThreads helpers;
  const std::vector<std::set<int>> of_one = processors_of_helpers(helpers, 1);
  EXPECT_EQ(of_one.front().size(), all.size() - 1);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), of_one.front().begin(), of_one.front().end()));
  // More of them than other processors: those that are added may use all.
  const std::size_t many = all.size() + 1;
  const std::vector<std::set<int>> of_many = processors_of_helpers(helpers, many);
  EXPECT_EQ(of_many.front(), of_one.front());
  EXPECT_EQ(of_many.back(), all);
  EXPECT_EQ(processors(), all) << "the caller may run where it could before";
}
#endif

TEST(HelperThreads, SleepAndWakeBetweenLoops) {
  HelperThreads helpers;
  for (int loop = 0; loop < 5; ++loop) {
    meet(helpers);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace
}  // namespace meshhood::test
