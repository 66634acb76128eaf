// SPDX-License-Identifier: MIT
// Answers in few leaves against a breadth-first search over vertices.
#include "exact/search/few_leaves.h"

#include <bit>
#include <cstdio>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/search/searcher_state.h"
#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

/// The leaves of the answer and of its neighbors.
std::set<LeafId> leaves_around(const SearchCase& c, const Ids& answer) {
  std::set<LeafId> leaves;
  for (const std::uint32_t v : answer) {
    leaves.insert(c.leaf_of_id(v));
    for (const std::uint32_t w : c.oracle.neighbors(v)) leaves.insert(c.leaf_of_id(w));
  }
  return leaves;
}

/// The result of a new search. Fails the test if the search gives up although `is_few`, or does not give up otherwise.
Ids find(const SearchCase& c, bool is_few) {
  VertexSet answer(c.index);
  EXPECT_EQ(FewLeaves(c.index, c.kernels).find(c.query.slot, c.query.ball, answer), is_few);
  Ids ids;
  answer.for_each([&](std::size_t vertex) { ids.push_back(c.index.id(vertex)); });
  return sorted(ids);
}

class FewLeavesOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(FewLeavesOnFamilies, FindsTheAnswersThatLieInFewLeavesAndNoOthers) {
  std::size_t few = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 6), 8, [&](const SearchCase& c) {
    const Ids expected = c.neighborhood();
    const bool is_few = leaves_around(c, expected).size() <= FewLeaves::kMostLeaves;
    ASSERT_EQ(find(c, is_few), is_few ? expected : Ids()) << c.mesh.name << ": vertex " << c.query.vertex;
    few += static_cast<std::size_t>(is_few);
  });
  std::printf("%zu of %zu answers lie in few leaves\n", few, cases);
}

TEST_P(FewLeavesOnFamilies, TellsWhetherTheAnswerIsOneVertex) {
  std::size_t isolated = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(40, 6), 8, [&](const SearchCase& c) {
    const bool is_isolated = c.neighborhood().size() == 1;
    ASSERT_EQ(FewLeaves(c.index, c.kernels).is_isolated(c.query.slot, c.query.center(), c.query.ball.squared_radius),
              is_isolated)
        << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
    isolated += static_cast<std::size_t>(is_isolated);
  });
  std::printf("%zu of %zu answers are one vertex\n", isolated, cases);
}

INSTANTIATE_TEST_SUITE_P(All, FewLeavesOnFamilies, testing::ValuesIn(families()), family_name);

/// Calls `f` for queries of `radius` at random vertices of a mesh.
template <class F>
void for_each_query(const TestMesh& mesh, double radius, std::size_t queries, F&& f) {
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Random random(7);
  for (std::size_t i = 0; i < queries; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const Query query(index, v, RadiusBounds(index.frame, radius));
    f(SearchCase{mesh, oracle, index, query, kernels(best_isa())});
  }
}

TEST(FewLeaves, FindsLeavesThatShareAPlaceInTheHashTable) {
  constexpr LeafId kTableSize = 64;
  const TestMesh mesh = bumpy_grid(150);
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  std::size_t shared = 0;
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    for (const Link& link : index.links_of(leaf)) {
      if (link.leaf % kTableSize != leaf % kTableSize) continue;
      const VertexId v = index.id(index.leaf_begin[leaf] + static_cast<std::size_t>(std::countr_zero(link.boundary)));
      const Query query(index, v, RadiusBounds(index.frame, 2));
      const SearchCase c{mesh, oracle, index, query, kernels(best_isa())};
      ASSERT_EQ(find(c, true), c.neighborhood()) << "vertex " << v;
      ++shared;
    }
  }
  EXPECT_GT(shared, 0U);
  std::printf("%zu links between leaves that share a place\n", shared);
}

TEST(FewLeaves, FollowsAllLinksOfAHub) {
  TestMesh mesh;
  for (std::size_t v = 0; v < 400; ++v) mesh.add_vertex(static_cast<double>(v), 0, 0);
  for (std::uint32_t v = 1; v < 400; ++v) mesh.add_face({0, v});
  for (std::uint32_t v = 2; v < 400; ++v) mesh.add_face({v - 1, v});
  mesh.finish(true);
  std::size_t few = 0;
  for (const double radius : {0.0, 1.0, 3.0, 100.0, std::numeric_limits<double>::infinity()}) {
    for_each_query(mesh, radius, 20, [&](const SearchCase& c) {
      const Ids expected = c.neighborhood();
      const bool is_few = leaves_around(c, expected).size() <= FewLeaves::kMostLeaves;
      ASSERT_EQ(find(c, is_few), is_few ? expected : Ids()) << "vertex " << c.query.vertex << ", radius " << radius;
      few += static_cast<std::size_t>(is_few);
    });
  }
  EXPECT_GT(few, 0U);
}

/// A searcher that answers no balls by a search over vertices, which has another order.
Searcher searcher_over_leaves(const Index& index) {
  Searcher searcher(index);
  SearcherAccess::state(searcher).vertex_bfs.answer_none();
  return searcher;
}

TEST(FewLeaves, OrderOfATinyBallDependsOnTheQueryAlone) {
  const TestMesh mesh = bumpy_grid(60);
  const Index index = build(mesh.view());
  Searcher used = searcher_over_leaves(index);
  std::vector<VertexId> expected;
  std::vector<VertexId> ids;
  for (VertexId v = 0; v < 50; ++v) used.neighborhood(v, 0.1, ids);
  for (VertexId v = 0; v < mesh.size(); v += 7) {
    for (const double radius : {0.0, 0.1, 1.0}) {
      searcher_over_leaves(index).neighborhood(v, radius, expected);
      used.neighborhood(v, radius, ids);
      ASSERT_EQ(ids, expected) << "vertex " << v << ", radius " << radius;
    }
  }
}

/// Every vertex in index order, so that most queries are in the leaf of the query before.
TEST(FewLeaves, AnswersOfNeighborsInTurnAreThoseOfTheOracle) {
  for (const Family& family : surface_families()) {
    const TestMesh mesh = make_mesh(family, 5, scaled(1500, 300));
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    const IndexView& view = IndexAccess::view(index);
    const double leaf_radius = view.tree[0].mean_radius / view.frame.scale;
    Searcher searcher = searcher_over_leaves(index);
    Ids ids;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      const VertexId v = view.id(i);
      for (const double radius : {0.2 * leaf_radius, 0.8 * leaf_radius, 1.39 * leaf_radius}) {
        searcher.neighborhood(v, radius, ids);
        ASSERT_EQ(sorted(ids), oracle.exact(v, radius)) << mesh.name << ": vertex " << v << ", radius " << radius;
      }
    }
  }
}

}  // namespace
}  // namespace meshhood::test
