// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paper/draft.h"
#include "paper/levels.h"

namespace meshhood::test {
namespace {

using paper::CandidateQueue;
using testing::ElementsAre;

std::vector<ClusterId> order_of(CandidateQueue& queue) {
  std::vector<ClusterId> order;
  while (!queue.empty()) order.push_back(queue.pop().cluster);
  return order;
}

TEST(Create, ACandidateHasItsClusterAndAllSiblings) {
  EXPECT_THAT(paper::create(path_level(4)), ElementsAre(2, 3, 3, 2));
  EXPECT_THAT(paper::create(star_level(3)), ElementsAre(4, 2, 2, 2));
  EXPECT_THAT(paper::create(level_on_line({0, 1}, {})), ElementsAre(1, 1));
}

TEST(CandidateQueue, TheAverageStaysWhenACandidateIsQueuedAgain) {
  CandidateQueue queue({4, 6, 5});  // average 5
  EXPECT_EQ(queue.pop().cluster, 2U);
  queue.insert(2, 1);
  EXPECT_THAT(order_of(queue), ElementsAre(0, 1, 2));
}

TEST(CandidateQueue, OrderIsByKeyThenId) {
  Random random(1);
  std::vector<VertexId> children(1000);
  double sum = 0;
  for (VertexId& count : children) sum += count = static_cast<VertexId>(1 + random.below(20));
  std::vector<std::tuple<double, ClusterId>> expected;
  expected.reserve(children.size());
  for (std::size_t c = 0; c < children.size(); ++c) {
    expected.emplace_back(std::abs(children[c] - sum / 1000), static_cast<ClusterId>(c));
  }
  std::sort(expected.begin(), expected.end());
  CandidateQueue queue(children);
  for (const auto& [key, cluster] : expected) ASSERT_EQ(queue.pop().cluster, cluster) << "key " << key;
}

}  // namespace
}  // namespace meshhood::test
