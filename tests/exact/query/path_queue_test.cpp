// SPDX-License-Identifier: MIT
// The queue of path searches, against a sorted container.
#include "exact/query/path_queue.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

/// A queue, and the lengths of its paths.
class PathQueueTest : public testing::Test {
 protected:
  void clear(double width) {
    queue_.clear(width);
    lengths_.clear();
  }

  void push(double length) {
    queue_.push({length, 7});
    lengths_.insert(length);
  }

  /// Takes a bucket: the shortest paths, ascending, none if the queue is empty.
  std::vector<double> take() {
    std::vector<double> taken;
    const bool has_paths = queue_.open();
    EXPECT_EQ(has_paths, !lengths_.empty());
    if (!has_paths) return {};
    queue_.take([&](const Path& path) { taken.push_back(path.length); });
    std::sort(taken.begin(), taken.end());
    EXPECT_FALSE(taken.empty());
    for (const double length : taken) {
      EXPECT_EQ(length, *lengths_.begin());
      lengths_.erase(lengths_.begin());
    }
    return taken;
  }

  [[nodiscard]] bool has_paths() const { return !lengths_.empty(); }

 private:
  PathQueue queue_;
  std::multiset<double> lengths_;
};

TEST_F(PathQueueTest, TakesTheShortestWhileNoShorterArePushed) {
  Random random(1);
  for (int round = 0; round < 300 && !HasFailure(); ++round) {
    // Whole numbers meet often; differences of 1e-300 are lost beside 1.
    const double unit = std::vector{1e-300, 0.37, 1.0, 1e300}[random.below(4)];
    // Buckets that hold one path, some, or all; and so narrow that few paths lie in a window.
    const double width = unit * std::vector{0.0, 1e-9, 0.01, 0.3, 5.0}[random.below(5)];
    const bool is_whole = random.below(2) == 0;
    const std::size_t most = std::vector{3U, 10U}[random.below(2)];
    clear(width);
    push(0);
    for (int step = 0; step < 100 && has_paths() && !HasFailure(); ++step) {
      std::vector<double> taken = take();
      if (taken.size() > 40) taken.resize(40);
      for (const double length : taken) {
        for (std::size_t i = random.below(step < 50 ? most : 2); i > 0; --i) {
          push(length + unit * (is_whole ? static_cast<double>(random.below(3)) : random.uniform(0, 2)));
        }
      }
    }
    while (has_paths() && !HasFailure()) take();
    take();
  }
}

TEST_F(PathQueueTest, TakesTheSmallestAndTheLargestLengths) {
  using Double = std::numeric_limits<double>;
  for (const double width : {0.0, 1.0, 1e300}) {
    clear(width);
    for (const double length : {Double::max(), 1.0, Double::min(), Double::denorm_min(), 0.0}) push(length);
    while (has_paths() && !HasFailure()) take();
    take();
  }
}

}  // namespace
}  // namespace meshhood::test
