// SPDX-License-Identifier: MIT
// All searchers satisfy `NeighborhoodSearcher`: their calls agree, and a visit gives the same vertices.
#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"
#include "meshhood/search.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/indexed.h"
#include "support/refusal.h"
#include "support/scale.h"
#include "support/sorted.h"

namespace meshhood::test {
namespace {

template <NeighborhoodSearcher S>
std::vector<VertexId> ids_of_visit(S& searcher, VertexId v, double radius) {
  std::vector<VertexId> ids;
  const bool all = visit(searcher, v, radius, [&](VertexRange run) {
    EXPECT_LT(run.begin, run.end);
    for (std::size_t i = run.begin; i < run.end; ++i) {
      ids.push_back(searcher.permutation().empty() ? static_cast<VertexId>(i) : searcher.permutation()[i]);
    }
  });
  EXPECT_TRUE(all);
  return ids;
}

/// Every call agrees with the ids alone, which other tests compare with the oracle.
template <NeighborhoodSearcher S>
void expect_consistent(S& searcher, const PositionsView& positions, VertexId v, double radius) {
  std::vector<VertexId> ids;
  std::vector<VertexId> same_ids;
  std::vector<double> distances;
  searcher.neighborhood(v, radius, ids);
  searcher.neighborhood(v, radius, same_ids, distances);
  EXPECT_EQ(sorted(same_ids), sorted(ids));
  ASSERT_EQ(distances.size(), ids.size());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    ASSERT_EQ(distances[i], distance(positions, v, same_ids[i]));
    ASSERT_LE(distances[i], radius);
  }
  EXPECT_EQ(searcher.neighborhood(v, radius), ids);
  EXPECT_EQ(searcher.count(v, radius), ids.size());
  EXPECT_EQ(sorted(ids_of_visit(searcher, v, radius)), sorted(ids));
  const auto add = [](std::size_t sum, VertexRange run) { return sum + run.size(); };
  EXPECT_EQ(reduce(searcher, v, radius, std::size_t{0}, add), ids.size());
}

MESHHOOD_SUITE_OF_FAMILIES(Searchers);

TEST_P(Searchers, AllMembersGiveTheSameAnswer) {
  const TestMesh mesh = make_mesh(GetParam(), 9, scaled(600, 200));
  if (mesh.size() == 0) return;
  const MeshView view = mesh.view();
  const Index index = build(view);
  const paper::Index hierarchy = paper::build(view);
  Searcher exact(index);
  paper::Searcher approximate(hierarchy);
  ReferenceSearcher reference(view);
  BallSearcher ball(view.positions);
  Searcher space(index, Metric::Space);
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const auto other = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = i % 10 == 0 ? kInfinity : distance(view.positions, v, other) * (i % 3 == 0 ? 1.0 : 0.4);
    const auto expect = [&](auto& searcher) {
      EXPECT_EQ(searcher.vertex_count(), mesh.size());
      expect_consistent(searcher, view.positions, v, radius);
    };
    expect(exact);
    expect(approximate);
    expect(reference);
    expect(ball);
    expect(space);
    EXPECT_EQ(sorted(space.neighborhood(v, radius)), ball.neighborhood(v, radius));
    EXPECT_EQ(exact.count(v, radius), reference.count(v, radius));
    EXPECT_LE(reference.count(v, radius), approximate.count(v, radius));
    EXPECT_LE(approximate.count(v, radius), ball.count(v, radius));
  }
}

/// The same vertices in the same order, the same distances and ranges.
template <NeighborhoodSearcher S>
void expect_same(const SearchMethod& method, S direct, VertexId v, double radius) {
  auto chosen = std::get<S>(method.make_searcher());
  EXPECT_EQ(chosen.vertex_count(), method.vertex_count());
  EXPECT_TRUE(std::ranges::equal(chosen.permutation(), direct.permutation()));
  std::vector<VertexId> ids;
  std::vector<VertexId> chosen_ids;
  std::vector<double> distances;
  std::vector<double> chosen_distances;
  direct.neighborhood(v, radius, ids);
  chosen.neighborhood(v, radius, chosen_ids);
  EXPECT_EQ(chosen_ids, ids);
  EXPECT_EQ(chosen.neighborhood(v, radius), ids);
  direct.neighborhood(v, radius, ids, distances);
  chosen.neighborhood(v, radius, chosen_ids, chosen_distances);
  EXPECT_EQ(chosen_ids, ids);
  EXPECT_EQ(chosen_distances, distances);
  EXPECT_EQ(chosen.count(v, radius), ids.size());
  EXPECT_TRUE(std::ranges::equal(chosen.ranges(v, radius), direct.ranges(v, radius)));
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { return chosen.count(v, -1); });
}

TEST_P(Searchers, OfAMethodGiveTheAnswersOfTheSearcherThatItNames) {
  const TestMesh mesh = make_mesh(GetParam(), 11, scaled(300, 100));
  if (mesh.size() == 0) return;
  const Index index = build(mesh.view());
  const paper::Index hierarchy = paper::build(mesh.view());
  const paper::QueryOptions options{.radius_ratio = 2};
  const Adjacency edges = adjacency(mesh.view());
  const GraphView graph{mesh.view().positions, edges.view()};
  Random random(4);
  for (int i = 0; i < 5; ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    const double radius = distance(graph.positions, v, static_cast<VertexId>(random.below(mesh.size())));
    expect_same(index, Searcher(index), v, radius);
    expect_same({hierarchy, options}, paper::Searcher(hierarchy, options), v, radius);
    expect_same(SearchMethod::breadth_first(graph), ReferenceSearcher(graph), v, radius);
    expect_same(SearchMethod(index).by(Metric::Path), Searcher(index, Metric::Path), v, radius);
    expect_same(SearchMethod::ball_scan(graph.positions), BallSearcher(graph.positions), v, radius);
    expect_same(SearchMethod(index).by(Metric::Space), Searcher(index, Metric::Space), v, radius);
  }
}

TEST(Visit, EndsWhenTheCallableReturnsFalse) {
  const auto [mesh, index] = indexed(make_grid(40, 40, false));
  Searcher searcher(index);
  std::size_t runs = 0;
  EXPECT_TRUE(visit(searcher, 820, 15, [&](VertexRange) { return ++runs > 0; }));
  ASSERT_GT(runs, 3U);
  std::size_t seen = 0;
  EXPECT_FALSE(visit(searcher, 820, 15, [&](VertexRange) { return ++seen < 3; }));
  EXPECT_EQ(seen, 3U);
}

TEST(Visit, ExceptionsReachTheCaller) {
  const auto [mesh, index] = indexed(make_grid(5, 5, false));
  Searcher searcher(index);
  EXPECT_THROW(visit(searcher, 3, 1, [](VertexRange) { throw std::runtime_error("stop"); }), std::runtime_error);
  const auto nothing = [](VertexRange) { FAIL(); };
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 25", [&] { visit(searcher, 25, 1, nothing); });
  expect_refused(ErrorCode::InvalidRadius, "radius -1", [&] { visit(searcher, 0, -1, nothing); });
}

TEST(Visit, PassesEachVertexOnceAlsoWithoutPermutation) {
  const TestMesh mesh = make_grid(30, 30, false);
  const ReorderedMesh reordered = reorder(mesh.view());
  Searcher searcher(reordered.index);
  EXPECT_TRUE(searcher.permutation().empty());
  expect_consistent(searcher, reordered.view().positions, 450, 7);
}

TEST(Reduce, AcceptsAMoveOnlyValue) {
  const TestMesh mesh = make_grid(30, 30, false);
  BallSearcher searcher(mesh.view().positions);
  const auto append = [](std::vector<VertexId> ids, VertexRange run) {
    ids.push_back(run.begin);
    return ids;
  };
  const std::vector<VertexId> begins = reduce(searcher, 450, 2, std::vector<VertexId>(), append);
  EXPECT_EQ(begins.size(), 5U);
  EXPECT_TRUE(std::is_sorted(begins.begin(), begins.end()));
}

}  // namespace
}  // namespace meshhood::test
