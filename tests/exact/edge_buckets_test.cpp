// SPDX-License-Identifier: MIT
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "exact/build/links.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(EdgeBuckets, HoldWhatEachThreadAdded) {
  constexpr unsigned kThreads = 3;
  constexpr std::size_t kBuckets = 5;
  EdgeBuckets buckets(kThreads, kBuckets);
  std::vector<std::vector<Edges>> added(kThreads, std::vector<Edges>(kBuckets));
  std::vector<std::thread> threads;
  for (unsigned thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      Random random(thread);
      // The last bucket stays empty; the first one of the first thread ends with a full block.
      for (std::uint32_t i = 0; i < 10000; ++i) {
        const std::size_t bucket = thread == 0 && i < 1024 ? 0 : 1 + random.below(kBuckets - 2);
        buckets.add(thread, bucket, {thread, i});
        added[thread][bucket].emplace_back(thread, i);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    Edges expected;
    for (const auto& of_thread : added) {
      expected.insert(expected.end(), of_thread[bucket].begin(), of_thread[bucket].end());
    }
    Edges found;
    buckets.take(bucket, [&](const SlotEdge& edge) { found.emplace_back(edge.from, edge.to); });
    EXPECT_EQ(found, expected) << "bucket " << bucket;
    buckets.take(bucket, [](const SlotEdge&) { FAIL() << "taken before"; });
  }
}

}  // namespace
}  // namespace meshhood::test
