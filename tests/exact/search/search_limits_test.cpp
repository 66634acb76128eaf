// SPDX-License-Identifier: MIT
// The record of recent outward searches decides which search answers the next ball.
#include "exact/search/search_limits.h"

#include <cfenv>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kSurface = 100;

/// After outward searches with a hundred surface leaves each.
SearchMemory memory_of(std::size_t answer, std::size_t steps) {
  SearchMemory memory;
  for (int i = 0; i < 20; ++i) {
    memory.begin_ball(1);
    memory.record({kSurface, answer, steps});
  }
  memory.begin_ball(1);
  return memory;
}

TEST(SearchLimits, LooksForLargerAnswersInFewLeavesNearTheQueryBefore) {
  const Index built = build(bumpy_grid(60).view());
  const IndexView& index = IndexAccess::view(built);
  const LeafId home = leaf_of(index.slot[30 * 60 + 30]);
  ASSERT_FALSE(index.links_of(home).empty());
  const SearchLimits limits;
  const double unit = index.tree[0].mean_radius;
  EXPECT_TRUE(limits.may_lie_in_few_leaves(0.3 * unit, home, false, index));
  EXPECT_FALSE(limits.may_lie_in_few_leaves(0.5 * unit, home, false, index));
  EXPECT_TRUE(limits.may_lie_in_few_leaves(1.9 * unit, home, true, index));
  EXPECT_FALSE(limits.may_lie_in_few_leaves(2.1 * unit, home, true, index));
}

TEST(SearchMemory, KnowsTheLeafOfTheQueryBefore) {
  SearchMemory memory;
  EXPECT_FALSE(memory.enter(0));
  EXPECT_TRUE(memory.enter(0));
  EXPECT_FALSE(memory.enter(7));
  EXPECT_TRUE(memory.enter(7));
  memory.clear();
  EXPECT_FALSE(memory.enter(7));
}

TEST(SearchMemory, HasNoPreferenceBeforeTheFirstSearch) {
  SearchMemory memory;
  memory.begin_ball(1);
  EXPECT_FALSE(memory.should_unite());
  EXPECT_FALSE(memory.is_answer_small());
}

TEST(SearchMemory, HasNoPreferenceAfterASingleSearch) {
  SearchMemory memory;
  memory.begin_ball(1);
  memory.record({kSurface, 1, 500});
  EXPECT_FALSE(memory.should_unite());
  EXPECT_FALSE(memory.is_answer_small());
}

TEST(SearchMemory, ComparesTheStepsWithUnitingAndWithTheAnswer) {
  const SearchMemory smooth = memory_of(75, 5);
  EXPECT_FALSE(smooth.should_unite());
  EXPECT_FALSE(smooth.is_answer_small());
  const SearchMemory small_answer = memory_of(30, 100);
  EXPECT_FALSE(small_answer.should_unite());
  EXPECT_TRUE(small_answer.is_answer_small());
  const SearchMemory divided = memory_of(900, 200);
  EXPECT_TRUE(divided.should_unite());
  EXPECT_FALSE(divided.is_answer_small());
}

TEST(SearchMemory, AddsUpAnswersOfAllSizes) {
  // In most balls, the steps outnumber the leaves of the answer; in all balls together, they do not.
  SearchMemory memory;
  for (int i = 0; i < 21; ++i) {
    memory.begin_ball(1);
    memory.record({kSurface, i % 4 == 0 ? 1000U : 10U, 50});
  }
  memory.begin_ball(1);
  EXPECT_FALSE(memory.is_answer_small());
}

TEST(SearchMemory, LeavesOutALargeStartThatFailedInMostRecentBalls) {
  SearchMemory memory;
  memory.begin_ball(1);
  EXPECT_FALSE(memory.should_start_small());
  for (int i = 0; i < 20; ++i) memory.record_large_start(false);
  EXPECT_TRUE(memory.should_start_small());
  for (int i = 0; i < 4; ++i) memory.record_large_start(true);
  EXPECT_FALSE(memory.should_start_small());
}

TEST(SearchMemory, IsIgnoredForOneBallInSixtyFour) {
  SearchMemory memory = memory_of(130, 200);
  std::size_t answered_no = 0;
  for (int i = 0; i < 640; ++i) {
    memory.begin_ball(1);
    EXPECT_EQ(memory.should_unite(), memory.is_answer_small());
    answered_no += static_cast<std::size_t>(!memory.should_unite());
  }
  EXPECT_EQ(answered_no, 10U);
  memory.clear();
  memory.begin_ball(1);
  EXPECT_FALSE(memory.is_answer_small());
}

TEST(SearchMemory, IsIgnoredForOneBallInSixteenOnceASearchWasTheRightOne) {
  SearchMemory memory = memory_of(130, 200);
  memory.begin_ball(1);
  memory.record({kSurface, 150, 60});
  ASSERT_TRUE(memory.is_answer_small()) << "on average";
  std::size_t answered_no = 0;
  for (int i = 0; i < 160; ++i) {
    memory.begin_ball(1);
    answered_no += static_cast<std::size_t>(!memory.is_answer_small());
  }
  EXPECT_EQ(answered_no, 10U);
}

TEST(SearchMemory, IsIgnoredTheLessOftenTheMoreStepsWereInVain) {
  SearchMemory memory = memory_of(10, 2000);  // 200 steps for each leaf of the answer
  std::size_t answered_no = 0;
  for (int i = 0; i < 4096; ++i) {
    memory.begin_ball(1);
    answered_no += static_cast<std::size_t>(!memory.is_answer_small());
  }
  EXPECT_EQ(answered_no, 2U);
  answered_no = 0;
  for (int i = 0; i < 32; ++i) {
    memory.begin_ball(3);
    answered_no += static_cast<std::size_t>(!memory.is_answer_small());
  }
  EXPECT_EQ(answered_no, 1U) << "balls of another size are tried at once";
}

TEST(SearchMemory, DoesNotDecayToDenormalNumbers) {
  SearchMemory memory = memory_of(30, 200);
  std::feclearexcept(FE_ALL_EXCEPT);
  for (int i = 0; i < 10'000; ++i) {
    memory.record({kSurface, 0, 0});
  }
  EXPECT_EQ(std::fetestexcept(FE_UNDERFLOW), 0);
}

TEST(SearchMemory, TellsWhetherMostAnswersWereOneVertex) {
  SearchMemory memory;
  EXPECT_FALSE(memory.expects_one_vertex());
  for (int i = 0; i < 20; ++i) memory.record_few_leaves(i % 4 != 0);
  EXPECT_TRUE(memory.expects_one_vertex());
  for (int i = 0; i < 20; ++i) memory.record_few_leaves(i % 4 == 0);
  EXPECT_FALSE(memory.expects_one_vertex());
  for (int i = 0; i < 20; ++i) memory.record_few_leaves(true);
  memory.clear();
  EXPECT_FALSE(memory.expects_one_vertex());
}

}  // namespace
}  // namespace meshhood::test
