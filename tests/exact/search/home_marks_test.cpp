// SPDX-License-Identifier: MIT
// Nodes with home marks, compared with breadth-first search.
#include "exact/search/home_marks.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class HomeMarksOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(HomeMarksOnFamilies, AreOnNodesOfTheAnswerOnly) {
  std::size_t marked = 0;
  const std::size_t searches = for_each_outward_search(
      GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, const SearcherAccess::State& state) {
        const Ids answer = c.neighborhood();
        for (const std::uint32_t group : state.descent.groups()) {
          const GroupState& known = state.states[group];
          ASSERT_EQ(known.home & ~known.whole, 0) << "a marked node is not whole";
          Ids ids;
          append_vertices(c.index, group, known.home, ids);
          for (const std::uint32_t w : ids) {
            ASSERT_TRUE(std::binary_search(answer.begin(), answer.end(), w))
                << c.mesh.name << ": vertex " << w << " seen from " << c.query.vertex << ", radius " << c.query.radius;
          }
          marked += ids.size();
        }
      });
  std::printf("%zu searches, %zu vertices of marked nodes\n", searches, marked);
}

INSTANTIATE_TEST_SUITE_P(Families, HomeMarksOnFamilies, testing::ValuesIn(families()), family_name);

TEST(HomeMarks, ReachAllWholeNodesInDoubtOfAFoldedSheet) {
  // A sheet that folds back over itself: much of the upper half is in doubt, and connected with the query vertex.
  TestMesh mesh = make_grid(60, 120, false);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    if (mesh.positions[i + 1] < 60) continue;
    mesh.positions[i + 1] = 119 - mesh.positions[i + 1];
    mesh.positions[i + 2] = 2;
  }
  const Index index = build(mesh.view());
  Searcher searcher(index);
  const SearcherAccess::State& state = SearcherAccess::state(searcher);
  EXPECT_EQ(searcher.count(30 * 60 + 30, 1000), mesh.size());
  ASSERT_TRUE(state.was_outward);
  std::size_t in_doubt = 0;
  for (const std::uint32_t group : state.descent.groups()) {
    const GroupState& known = state.states[group];
    in_doubt += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(known.whole & known.in_doubt)));
    EXPECT_EQ(known.whole & known.in_doubt & ~known.home, 0);
  }
  EXPECT_GT(in_doubt, 0U);
}

}  // namespace
}  // namespace meshhood::test
