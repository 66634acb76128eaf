// SPDX-License-Identifier: MIT
// The outward search without its limits: the breadth-first search never answers, so every answer is the part that the
// outward search has reached, without the other components. Compared with the oracle on all families.
#include <gtest/gtest.h>

#include "support/differential.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class SearchOutward : public testing::TestWithParam<Family> {};

TEST_P(SearchOutward, AloneGivesTheAnswersOfTheOracle) {
  std::size_t outward = 0;
  std::size_t of_crumbs = 0;
  const auto without_limits = [](Searcher& searcher) { SearcherAccess::state(searcher).limits.enabled = false; };
  const auto count = [&](Searcher& searcher, VertexId v) {
    const SearcherAccess::State& state = SearcherAccess::state(searcher);
    outward += static_cast<std::size_t>(state.was_outward);
    // Vertices of crumbs are answered within their leaf.
    of_crumbs += static_cast<std::size_t>(!state.index->leaves[leaf_of(state.index->slot[v])].connected);
  };
  const Tally tally = compare_family(GetParam(), scaled(25, 2), 150, without_limits, count);
  EXPECT_EQ(outward + of_crumbs, tally.queries);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchOutward, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
