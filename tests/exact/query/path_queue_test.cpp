// SPDX-License-Identifier: MIT
// The queue of path searches, against a sorted container.
#include "exact/query/path_queue.h"

#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/random.h"

namespace meshhood::test {
namespace {

/// A queue and the lengths of its paths. Paths are named by the order in which they were pushed.
class PathQueueTest : public testing::Test {
 protected:
  void clear(double width) {
    queue_.clear(width);
    lengths_.clear();
    valid_.clear();
  }

  void push(const std::vector<double>& lengths) {
    Path* room = queue_.room(lengths.size() + 2);  // more room than needed
    double least = std::numeric_limits<double>::infinity();
    for (const double length : lengths) {
      *room++ = {length, static_cast<std::uint32_t>(valid_.size())};
      lengths_.insert(length);
      valid_.push_back(true);
      least = std::min(least, length);
    }
    queue_.push(lengths.size(), least);
  }

  /// Makes a path invalid.
  void drop(const Path& path) {
    valid_[path.end] = false;
    lengths_.erase(lengths_.find(path.length));
  }

  /// Returns the length of the path taken.
  double pop() {
    Path path{};
    const bool has_path = queue_.pop(path, [&](const Path& p) { return valid_[p.end]; }, [](const Path&) {});
    EXPECT_EQ(has_path, !lengths_.empty());
    if (!has_path) return 0;
    EXPECT_EQ(path.length, *lengths_.begin());
    EXPECT_TRUE(valid_[path.end]);
    drop(path);
    return path.length;
  }

  [[nodiscard]] bool has_paths() const { return !lengths_.empty(); }

 private:
  PathQueue queue_;
  std::multiset<double> lengths_;  // of the valid paths
  std::vector<bool> valid_;        // by path: neither taken nor dropped
};

TEST_F(PathQueueTest, TakesTheShortestWhileNoShorterArePushed) {
  Random random(1);
  for (int round = 0; round < 300 && !HasFailure(); ++round) {
    // Whole numbers meet often; differences of 1e-300 are lost beside 1.
    const double unit = std::vector{1e-300, 0.37, 1.0, 1e300}[random.below(4)];
    // Buckets that hold one path, some, or all; and so narrow that few paths lie in a window.
    const double width = unit * std::vector{0.0, 1e-9, 0.01, 0.3, 5.0}[random.below(5)];
    const bool is_whole = random.below(2) == 0;
    const std::size_t most = std::vector{3U, 40U}[random.below(2)];
    clear(width);
    push({0});
    for (int step = 0; step < 400 && has_paths(); ++step) {
      const double last = pop();
      std::vector<double> lengths;
      for (std::size_t i = random.below(step < 200 ? most : 2); i > 0; --i) {
        const double by = is_whole ? static_cast<double>(random.below(3)) : random.uniform(0, 2);
        lengths.push_back(last + unit * by);
      }
      push(lengths);
    }
    while (has_paths()) pop();
    pop();
  }
}

TEST_F(PathQueueTest, DropsInvalidPaths) {
  Random random(2);
  for (int round = 0; round < 50 && !HasFailure(); ++round) {
    clear(random.uniform(0, 0.2));
    std::vector<double> lengths(200);
    for (double& length : lengths) length = random.uniform(0, 3);
    push(lengths);
    for (std::uint32_t path = 0; path < lengths.size(); ++path) {
      if (random.below(2) == 0) drop({lengths[path], path});
    }
    while (has_paths()) pop();
    pop();
  }
}

TEST_F(PathQueueTest, TakesTheSmallestAndTheLargestLengths) {
  using Limits = std::numeric_limits<double>;
  for (const double width : {0.0, 1.0, 1e300}) {
    clear(width);
    push({Limits::max(), 1.0, Limits::min(), Limits::denorm_min(), 0.0});
    while (has_paths()) pop();
    pop();
  }
}

}  // namespace
}  // namespace meshhood::test
