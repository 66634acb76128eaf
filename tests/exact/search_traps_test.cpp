// SPDX-License-Identifier: MIT
// Rules of the outward search that are easily broken. On a folded sheet the ball does not reach the fold, but nodes
// across its surface do, so the outward search reaches the other half. Without its rule, each of these tests fails.
#include <bit>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/folded_sheet.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

constexpr std::uint32_t kFoldRow = 100;

/// Calls `f(case, state)` after outward searches whose balls end shortly before the fold.
template <class F>
void for_each_ball_before_the_fold(const TestMesh& mesh, F&& f) {
  const Oracle oracle(mesh);
  const Index index = build(mesh.view());
  for (Searcher& searcher : searchers_of(index)) {
    SearcherAccess::State& state = SearcherAccess::state(searcher);
    state.limits.enabled = false;
    for (std::uint32_t row = 40; row < 80; row += 5) {
      for (const double below : {0.5, 1.5, 3.5}) {
        const VertexId v = row * kFoldRow + kFoldRow / 2;
        const double radius = static_cast<double>(kFoldRow - 1 - row) - below;
        std::vector<VertexId> ids;
        searcher.neighborhood(v, radius, ids);
        const Query query(*state.index, v, RadiusBounds(state.index->frame, radius));
        const SearchCase c{mesh, oracle, *state.index, query, *state.kernels};
        ASSERT_EQ(sorted(std::move(ids)), c.neighborhood()) << "vertex " << v << ", radius " << radius;
        ASSERT_TRUE(state.was_outward);
        f(c, state);
      }
    }
  }
}

/// The number of whole nodes above the leaves that are in doubt, not marked, and not part of the answer.
std::size_t large_others(const SearchCase& c, const SearcherAccess::State& state) {
  const Ids answer = c.neighborhood();
  std::size_t found = 0;
  for (const std::uint32_t group : state.descent.groups()) {
    if (group < c.index.leaf_count() / kFanOut) continue;
    const GroupState& known = state.states[group];
    for_each_node(known.whole & known.in_doubt & static_cast<NodeSet>(~known.home), [&](unsigned i) {
      const std::uint32_t v = c.index.id(c.index.records[group].begin[i]);
      found += static_cast<std::size_t>(!std::binary_search(answer.begin(), answer.end(), v));
    });
  }
  return found;
}

// The nearest vertex of the other half lies below a large whole node. Its leaf is not a surface leaf, and found only by
// descending from that node.
TEST(SearchTraps, LeavesBelowLargeNodesOfAnotherComponentAreCandidates) {
  std::size_t others = 0;
  for_each_ball_before_the_fold(
      make_folded_sheet(kFoldRow),
      [&](const SearchCase& c, const SearcherAccess::State& state) { others += large_others(c, state); });
  EXPECT_GT(others, 10U);
  std::printf("%zu large nodes of other components in doubt\n", others);
}

// A traversal may meet vertices that another one has reached. They are connected with the query vertex only because the
// minima are processed in order of distance: the nearest one of a component exhausts it for all others.
TEST(SearchTraps, MinimaOfOneComponentAreRemovedTogether) {
  std::size_t with_several = 0;
  for_each_ball_before_the_fold(
      make_folded_sheet(kFoldRow, 1.5), [&](const SearchCase&, const SearcherAccess::State& state) {
        const bool has_others = !state.other_components.found().empty();
        with_several += static_cast<std::size_t>(has_others && state.loose.minima().size() > 1);
      });
  EXPECT_GT(with_several, 5U);
  std::printf("%zu queries with several minima of another component\n", with_several);
}

// A piece of a leaf that touches a whole node belongs to the answer only if that node is marked: the whole nodes of the
// other half touch pieces of their own component. Uniting pieces looks from the smaller node to the larger, too.
TEST(SearchTraps, PiecesThatTouchNodesOfAnotherComponentAreRemoved) {
  std::size_t removed = 0;
  for_each_ball_before_the_fold(
      make_folded_sheet(kFoldRow, 1.5), [&](const SearchCase& c, const SearcherAccess::State& state) {
        ReachedComponents components(c.index, c.kernels);
        VertexSet answer(c.index);
        components.find(c.query, state.descent.groups(), state.surface_leaves, state.states, answer);
        ASSERT_EQ(answer.count(), c.neighborhood().size());
        removed += static_cast<std::size_t>(std::count_if(state.surface_leaves.begin(), state.surface_leaves.end(),
                                                          [&](const LeafSubset& leaf) { return leaf.lanes != 0; }));
        removed -= answer.subsets().size();
      });
  EXPECT_GT(removed, 50U);
  std::printf("%zu surface leaves removed\n", removed);
}

/// A flat strip of `width` by `length` vertices, and another one beside it, joined at one end: like a hairpin.
TestMesh make_hairpin(std::uint32_t width, std::uint32_t gap, std::uint32_t length) {
  TestMesh mesh = make_grid(2 * width + gap, length, false);
  const auto is_there = [&](std::uint32_t v) {
    const std::uint32_t x = v % (2 * width + gap);
    return x < width || x >= width + gap || v / (2 * width + gap) >= length - width;
  };
  TestMesh hairpin;
  std::vector<std::uint32_t> ids(mesh.size());
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    if (is_there(v)) ids[v] = hairpin.add_vertex(mesh.positions[3 * v], mesh.positions[3 * v + 1], 0);
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (!std::all_of(face.begin(), face.end(), is_there)) continue;
    hairpin.add_face({ids[face[0]], ids[face[1]], ids[face[2]]});
  }
  return hairpin.finish(true);
}

// A small node beside a large one marks it if it leads home and is linked with it. Another node of the group of the
// large one, across the bend of the hairpin, is no reason: the bend lies at the surface of the ball.
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
      with_others += static_cast<std::size_t>(!SearcherAccess::state(searcher).other_components.found().empty());
    }
  }
  EXPECT_GT(with_others, 50U);
  std::printf("%zu queries with other components\n", with_others);
}

}  // namespace
}  // namespace meshhood::test
