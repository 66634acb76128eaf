// SPDX-License-Identifier: MIT
// Home marks, compared with breadth-first search.
#include "exact/search/home_marks.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class HomeMarksOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(HomeMarksOnFamilies, AreOnVerticesOfTheAnswerAndOnTheQueryVertex) {
  std::size_t marked = 0;
  std::size_t open = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(25, 3), 4, [&](const SearchCase& c, OutwardSearch& search) {
        search.marks.spread(c.query, search.reach);
        const Ids ids = sorted(search.marked(c));
        const Ids answer = c.neighborhood();
        ASSERT_TRUE(std::includes(answer.begin(), answer.end(), ids.begin(), ids.end()))
            << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
        ASSERT_TRUE(std::binary_search(ids.begin(), ids.end(), c.query.vertex));
        marked += ids.size();
        open += answer.size() - ids.size();
      });
  std::printf("%zu searches, %zu vertices marked, %zu of the answer open\n", searches, marked, open);
}

TEST_P(HomeMarksOnFamilies, AreConnectedWithinTheirLeavesAndOpenWhereTheyAreNot) {
  for_each_outward_search(GetParam(), scaled(15, 3), 3, [&](const SearchCase& c, OutwardSearch& search) {
    search.marks.spread(c.query, search.reach);
    std::vector<std::uint32_t> open_groups;
    for (const std::uint32_t group : search.reach.groups()) {
      const GroupState& state = search.reach.states()[group];
      ASSERT_EQ(state.home & ~state.whole, 0) << "a marked node is not whole";
      if (state.home != state.whole) open_groups.push_back(group);
    }
    ASSERT_THAT(search.marks.open_groups(), testing::ElementsAreArray(open_groups));
    std::vector<std::size_t> open_places;
    const std::span<const LeafSubset> leaves = search.reach.surface_leaves();
    for (std::size_t place = 0; place < leaves.size(); ++place) {
      const LaneMask lanes = search.marks.lanes(place);
      const LaneMask* adjacency = &c.index.adjacency[c.index.leaf_begin[leaves[place].leaf]];
      for_each_lane(lanes, [&](unsigned lane) {
        ASSERT_EQ(adjacency[lane] & leaves[place].lanes & ~lanes, 0U) << "half of a piece is marked";
      });
      if (lanes != leaves[place].lanes) open_places.push_back(place);
    }
    ASSERT_THAT(search.marks.open_places(), testing::ElementsAreArray(open_places));
  });
}

TEST_P(HomeMarksOnFamilies, HaveTheLeavesBelowMarkedNodes) {
  std::size_t below = 0;
  for_each_outward_search(GetParam(), scaled(15, 3), 3, [&](const SearchCase& c, OutwardSearch& search) {
    search.marks.spread(c.query, search.reach);
    for (LeafId leaf = 0; leaf < c.index.leaf_count(); ++leaf) {
      if (c.index.leaves[leaf].size == 0) continue;
      const NodeId whole = search.reach.states().whole_node(leaf);
      const bool is_marked =
          whole != kNoNode && (search.reach.states()[whole / kFanOut].home >> whole % kFanOut & 1U) != 0;
      ASSERT_EQ(search.marks.has(leaf) != 0, is_marked) << c.mesh.name << ": leaf " << leaf;
      below += static_cast<std::size_t>(is_marked);
    }
  });
  std::printf("%zu leaves below marked nodes\n", below);
}

INSTANTIATE_TEST_SUITE_P(Families, HomeMarksOnFamilies, testing::ValuesIn(families()), family_name);

/// Vertices of whole nodes and of surface leaves that have no mark, summed over queries and levels.
struct Open {
  std::size_t nodes = 0;
  std::size_t lanes = 0;
  std::size_t all = 0;
};

Open open_vertices(const TestMesh& mesh, VertexId first, VertexId step, double radius) {
  Open open;
  VertexId v = first;
  const auto draw = [&](const Oracle&) { return std::vector<std::pair<VertexId, double>>{{v += step, radius}}; };
  for_each_level(mesh, 10, draw, [&](const SearchCase& c, OutwardSearch& search) {
    search.marks.spread(c.query, search.reach);
    for (const std::uint32_t group : search.marks.open_groups()) {
      const GroupState& state = search.reach.states()[group];
      Ids ids;
      append_vertices(c.index, group, static_cast<NodeSet>(state.whole & ~state.home), ids);
      open.nodes += ids.size();
    }
    for (const std::size_t place : search.marks.open_places()) {
      open.lanes += count_of(search.reach.surface_leaves()[place].lanes & ~search.marks.lanes(place));
    }
    open.all += c.neighborhood().size();
  });
  return open;
}

// What has no mark is right but slow, so here the marks must be nearly complete.
TEST(HomeMarks, LeaveNearlyNothingOpenOnASingleSheet) {
  const Open open = open_vertices(bumpy_grid(120), 50 * 120 + 60, 77, 35);
  std::printf("%zu vertices of nodes and %zu of surface leaves are open, of %zu\n", open.nodes, open.lanes, open.all);
  EXPECT_EQ(open.nodes, 0U);
  EXPECT_LT(open.lanes, open.all / 200);
}

}  // namespace
}  // namespace meshhood::test
