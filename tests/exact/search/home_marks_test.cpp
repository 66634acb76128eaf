// SPDX-License-Identifier: MIT
// Nodes with home marks, compared with breadth-first search.
#include "exact/search/home_marks.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <utility>

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

TEST_P(HomeMarksOnFamilies, LeadHomeFromNodesOfTheAnswerOnly) {
  std::size_t asked = 0;
  std::size_t home = 0;
  std::size_t by_smaller = 0;
  for_each_outward_search(GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, const SearcherAccess::State& state) {
    const Ids answer = c.neighborhood();
    GroupStates states = state.states;
    HomeMarks marks(c.index);
    for (const std::uint32_t group : state.descent.groups()) {
      for_each_node(states[group].whole, [&](unsigned i) {
        const NodeId node = group * kFanOut + i;
        const bool leads = marks.leads_home(node, states);
        const bool smaller = !leads && marks.smaller_leads_home(node, states);
        Ids ids;
        append_vertices(c.index, group, node_at(i), ids);
        const bool is_in_answer = std::binary_search(answer.begin(), answer.end(), ids.front());
        ASSERT_TRUE(is_in_answer || !(leads || smaller))
            << c.mesh.name << ": node " << node << " from " << c.query.vertex << ", radius " << c.query.radius;
        ++asked;
        home += static_cast<std::size_t>(leads);
        by_smaller += static_cast<std::size_t>(smaller);
      });
    }
  });
  std::printf("%zu whole nodes, %zu lead home, %zu more by smaller nodes\n", asked, home, by_smaller);
}

INSTANTIATE_TEST_SUITE_P(Families, HomeMarksOnFamilies, testing::ValuesIn(families()), family_name);

/// Two square pads, joined by a narrow bridge, from whose middle a long tail leads away.
TestMesh pads_with_bridge() {
  const auto is_there = [](int x, int y) {
    const bool in_pad = y >= 0 && y <= 40 && ((x >= 0 && x <= 40) || (x >= 50 && x <= 90));
    const bool in_bridge = y >= 20 && y <= 22 && x >= 40 && x <= 50;
    const bool in_tail = x >= 44 && x <= 46 && y >= 22 && y <= 260;
    return in_pad || in_bridge || in_tail;
  };
  TestMesh mesh;
  std::map<std::pair<int, int>, std::uint32_t> ids;
  const auto vertex = [&](int x, int y) {
    const auto [at, is_new] = ids.try_emplace({x, y}, static_cast<std::uint32_t>(mesh.size()));
    if (is_new) mesh.add_vertex(x, y, 0);
    return at->second;
  };
  for (int y = 0; y < 260; ++y) {
    for (int x = 0; x < 90; ++x) {
      if (!is_there(x, y) || !is_there(x + 1, y) || !is_there(x, y + 1) || !is_there(x + 1, y + 1)) continue;
      const std::array corners{vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)};
      mesh.add_face(corners);
    }
  }
  return mesh.finish(true);
}

TEST(HomeMarks, ReachALargeNodeOverTheSmallOnesBesideIt) {
  const TestMesh mesh = pads_with_bridge();
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Searcher searcher(built);
  SearcherAccess::State& state = SearcherAccess::state(searcher);
  state.limits.enabled = false;
  std::size_t by_smaller = 0;
  for (const double radius : {60.0, 65.0, 70.0, 75.0, 80.0}) {
    EXPECT_GT(searcher.count(400, radius), 0U);
    // As before the first call.
    GroupStates states = state.states;
    for (const std::uint32_t group : state.descent.groups()) states[group].home = states[group].explored = 0;
    HomeMarks marks(index);
    marks.mark(leaf_of(index.slot[400]), states);
    for (const std::uint32_t group : state.descent.groups()) {
      for_each_node(states[group].whole, [&](unsigned i) {
        const NodeId node = group * kFanOut + i;
        if (!marks.leads_home(node, states) && marks.smaller_leads_home(node, states)) ++by_smaller;
      });
    }
  }
  EXPECT_GT(by_smaller, 0U);
}

TEST(HomeMarks, ReachAllWholeNodesInDoubtOfAFoldedSheet) {
  // A sheet that folds back over itself: much of the upper half is in doubt, and connected with the query vertex.
  TestMesh mesh = make_grid(60, 120, false);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    if (mesh.positions[i + 1] < 60) continue;
    mesh.positions[i + 1] = 119 - mesh.positions[i + 1];
    mesh.positions[i + 2] = 2;
  }
  mesh.finish(true);
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
