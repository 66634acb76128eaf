// SPDX-License-Identifier: MIT
// Answers within the leaf of the query vertex against a breadth-first search over vertices.
#include "exact/search/single_leaf.h"

#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

class SingleLeafOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(SingleLeafOnFamilies, FindsTheAnswersThatLieInOneLeafAndNoOthers) {
  std::size_t in_leaf = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 6), 8, [&](const SearchCase& c) {
    const LeafId leaf = c.query.leaf();
    const Ids expected = c.neighborhood();
    const bool is_in_leaf =
        std::all_of(expected.begin(), expected.end(), [&](std::uint32_t w) { return c.leaf_of_id(w) == leaf; });
    Ids found;
    for_each_lane(SingleLeaf(c.index, c.kernels).find(c.query),
                  [&](unsigned lane) { found.push_back(c.id(leaf, lane)); });
    ASSERT_EQ(sorted(found), is_in_leaf ? expected : Ids()) << c.mesh.name << ": vertex " << c.query.vertex;
    in_leaf += static_cast<std::size_t>(is_in_leaf);
  });
  std::printf("%zu of %zu answers lie in one leaf\n", in_leaf, cases);
}

INSTANTIATE_TEST_SUITE_P(All, SingleLeafOnFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
