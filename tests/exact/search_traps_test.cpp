// SPDX-License-Identifier: MIT
// Rules of the outward search that are easily broken. On a folded sheet the ball does not reach the fold, but nodes
// across its surface do, so the outward search reaches the other half. Without its rule, each of these tests fails.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "exact/query/single_queries.h"
#include "support/indexed.h"
#include "support/search_case.h"
#include "support/sheets.h"

namespace meshhood::test {
namespace {

constexpr std::uint32_t kFoldRow = 100;

/// Calls `f(case, state)` after outward searches whose balls end shortly before the fold.
template <class F>
void for_each_ball_before_the_fold(const TestMesh& mesh, F&& f) {
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  for (Searcher& searcher : searchers_of(index)) {
    const SearcherAccess::State& state = SearcherAccess::state(searcher);
    for (std::uint32_t row = 40; row < 80; row += 5) {
      for (const double below : {0.5, 1.5, 3.5}) {
        const VertexId v = row * kFoldRow + kFoldRow / 2;
        const double radius = static_cast<double>(kFoldRow - 1 - row) - below;
        std::vector<VertexId> ids;
        searcher.neighborhood(v, radius, ids);
        const Query query(*state.index, v, RadiusBounds(state.index->frame, radius));
        const SearchCase c{mesh, oracle, *state.index, query, *state.kernels};
        ASSERT_EQ(sorted(std::move(ids)), c.neighborhood()) << "vertex " << v << ", radius " << radius;
        ASSERT_EQ(state.way, SearcherAccess::State::Way::Component);
        f(c, state);
      }
    }
  }
}

/// What the last query has reached of other components.
struct Others {
  std::size_t large = 0;   // whole nodes above the leaves
  std::size_t leaves = 0;  // whole
};

Others others_of(const SearcherAccess::State& state) {
  Others others;
  for (const std::uint32_t group : state.reach.groups()) {
    const GroupState& known = state.reach.states()[group];
    (state.index->is_of_leaves(group) ? others.leaves : others.large) +=
        count_of(known.whole & ~unsigned{known.marked});
  }
  return others;
}

TEST(SearchTraps, LargeNodesOfAnotherComponentAreLeftOut) {
  std::size_t large = 0;
  for_each_ball_before_the_fold(
      make_folded_sheet(kFoldRow),
      [&](const SearchCase&, const SearcherAccess::State& state) { large += others_of(state).large; });
  EXPECT_GT(large, 10U);
  std::printf("%zu large nodes of other components\n", large);
}

// A piece of a leaf that touches a whole node belongs to the answer only if that node is marked: the whole nodes of the
// other half touch pieces of their own component.
TEST(SearchTraps, PiecesThatTouchNodesOfAnotherComponentAreLeftOut) {
  std::size_t pieces = 0;
  for_each_ball_before_the_fold(make_folded_sheet(kFoldRow, 1.5), [&](const SearchCase& c,
                                                                      const SearcherAccess::State& state) {
    const Ids answer = c.neighborhood();
    for (const LeafSubset& leaf : state.reach.surface_leaves()) {
      for_each_lane(leaf.lanes, [&](unsigned lane) {
        pieces += static_cast<std::size_t>(!std::binary_search(answer.begin(), answer.end(), c.id(leaf.leaf, lane)));
      });
    }
  });
  EXPECT_GT(pieces, 50U);
  std::printf("%zu vertices of surface leaves left out\n", pieces);
}

// The surface of the ball reaches the fold; the upper half is connected there, or not at all.
TEST(SearchTraps, AHalfIsUnitedOverTheFoldOrLeftOut) {
  const auto [mesh, index] = indexed(make_folded_sheet(160));
  Searcher searcher(index);
  ReferenceSearcher reference(mesh.view());
  std::size_t outward = 0;
  std::vector<VertexId> ids;
  for (std::uint32_t row = 60; row < 140; ++row) {
    for (const double beyond : {-1.2, 0.2, 0.8}) {
      const VertexId v = row * 160 + 80;
      const double radius = 159 - row + beyond;
      searcher.neighborhood(v, radius, ids);
      outward += static_cast<std::size_t>(SearcherAccess::state(searcher).way == SearcherAccess::State::Way::Component);
      ASSERT_EQ(ids.size(), reference.count(v, radius)) << "vertex " << v << ", radius " << radius;
    }
  }
  EXPECT_GT(outward, 200U);
}

// A small node beside a large one marks it if it is linked with it. Another node of the group of the large one, across
// the bend of the hairpin, is no reason: the bend lies at the surface of the ball.
TEST(SearchTraps, ASmallNodeMarksOnlyTheLargeNodeBesideIt) {
  const TestMesh mesh = make_hairpin(16, 3, 88);
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  std::size_t with_others = 0;
  for (std::uint32_t v = 0; v < mesh.size(); v += 20) {
    for (const double radius : {30.0, 40.0, 50.0, 60.0}) {
      std::vector<VertexId> ids;
      searcher.neighborhood(v, radius, ids);
      ASSERT_EQ(sorted(std::move(ids)), oracle.exact(v, radius)) << "vertex " << v << ", radius " << radius;
      const Others others = others_of(SearcherAccess::state(searcher));
      with_others += static_cast<std::size_t>(others.large + others.leaves > 0);
    }
  }
  EXPECT_GT(with_others, 50U);
  std::printf("%zu queries with other components\n", with_others);
}

}  // namespace
}  // namespace meshhood::test
