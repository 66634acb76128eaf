// SPDX-License-Identifier: MIT
// Which balls a searcher answers by breadth-first search over vertices, and its answers there.
#include "exact/search/vertex_bfs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/refit.h"
#include "meshhood/reorder.h"
#include "meshhood/serialize.h"

#include "base/limits.h"
#include "support/family_name.h"
#include "support/index_bytes.h"
#include "support/refusal.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

/// Every vertex is joined to one of `hubs` vertices.
TestMesh make_hubs(std::size_t vertices, std::size_t hubs) {
  Random random(3);
  TestMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
  for (std::size_t v = hubs; v < vertices; ++v) {
    mesh.add_face({static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(random.below(hubs))});
  }
  return mesh.finish(true);
}

TestMesh make_random_graph(std::size_t vertices, std::size_t edges) {
  TestMesh mesh = make_hubs(vertices, vertices);
  Random random(4);
  for (std::size_t i = 0; i < edges; ++i) {
    mesh.add_face(
        {static_cast<std::uint32_t>(random.below(vertices)), static_cast<std::uint32_t>(random.below(vertices))});
  }
  return mesh;
}

bool is_odd(const TestMesh& mesh) {
  const Index index = build(mesh.view());
  return is_unlike_a_surface(IndexAccess::view(index));
}

/// Compares every kind of answer with the oracle.
void expect_answers(Searcher& searcher, const Oracle& oracle, VertexId v, double radius) {
  const Ids expected = oracle.exact(v, radius);
  Ids ids;
  std::vector<double> distances;
  searcher.neighborhood(v, radius, ids, distances);
  ASSERT_EQ(distances.size(), ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) ASSERT_EQ(distances[k], oracle.distance(v, ids[k]));
  ASSERT_EQ(sorted(ids), expected);
  searcher.neighborhood(v, radius, ids);
  ASSERT_EQ(sorted(ids), expected);
  ASSERT_EQ(searcher.count(v, radius), expected.size());
  std::size_t in_ranges = 0;
  for (const VertexRange& range : searcher.ranges(v, radius)) in_ranges += range.end - range.begin;
  ASSERT_EQ(in_ranges, expected.size());
}

class VertexBfsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(VertexBfsOnFamilies, FindsTheNeighborhoodAndItsRanges) {
  std::size_t queries = 0;
  for (std::uint64_t seed = 0; seed < scaled(10, 2); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    VertexBfs bfs(IndexAccess::view(index));
    bfs.answer_all();
    Random random(seed);
    for (int i = 0; i < 5; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        const std::span<const VertexId> found = bfs.find(v, radius);
        ASSERT_EQ(sorted(Ids(found.begin(), found.end())), oracle.exact(v, radius))
            << mesh.name << ": vertex " << v << ", radius " << radius;
        Ids in_ranges;
        std::size_t end = 0;
        for (const VertexRange& range : bfs.ranges_of(found)) {
          ASSERT_TRUE(in_ranges.empty() || range.begin > end) << "ranges ascend and do not touch";
          ASSERT_LT(range.begin, range.end);
          end = range.end;
          for (std::size_t at = range.begin; at < end; ++at) in_ranges.push_back(index.permutation()[at]);
        }
        ASSERT_EQ(sorted(in_ranges), oracle.exact(v, radius));
        ++queries;
      }
    }
  }
  std::printf("%zu queries\n", queries);
}

/// Every kind of answer of one searcher in turn, so that the searches over vertices and over leaves mix.
TEST_P(VertexBfsOnFamilies, AnswersOfASearcherOfASmallMeshAreThoseOfTheOracle) {
  std::size_t over_vertices = 0;
  std::size_t over_leaves = 0;
  for (std::uint64_t seed = 0; seed < scaled(8, 2); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 1000);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    Searcher searcher(index);
    VertexBfs& bfs = SearcherAccess::state(searcher).vertex_bfs;
    Random random(seed);
    for (std::size_t i = 0; i < 30; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        expect_answers(searcher, oracle, v, radius);
        const bool is_found = !bfs.find(v, radius).empty();
        ++(is_found ? over_vertices : over_leaves);
      }
    }
  }
  std::printf("%zu queries over vertices, %zu over leaves\n", over_vertices, over_leaves);
  EXPECT_EQ(over_vertices > 0, GetParam().name != "nothing");
}

INSTANTIATE_TEST_SUITE_P(Families, VertexBfsOnFamilies, testing::ValuesIn(families()), family_name);

TEST(VertexBfs, HubsAndRandomGraphsAreUnlikeASurface) {
  for (const std::size_t hubs : {1U, 20U, 60U}) EXPECT_TRUE(is_odd(make_hubs(6000, hubs))) << hubs << " hubs";
  for (const std::size_t degree : {2U, 6U, 20U}) {
    EXPECT_TRUE(is_odd(make_random_graph(20'000, 10'000 * degree))) << "degree " << degree;
  }
}

TEST(VertexBfs, ACombIsUnlikeASurface) {
  const std::vector<Family> all = families();
  const auto far_away = std::find_if(all.begin(), all.end(), [](const Family& f) { return f.name == "far away"; });
  ASSERT_NE(far_away, all.end());
  EXPECT_TRUE(is_odd(make_mesh(*far_away, 1, 20'000))) << "a link of one edge for every four vertices";
}

TEST(VertexBfs, SurfacesAndGraphsWithoutEdgesAreNotUnlikeASurface) {
  for (const Family& family : surface_families()) {
    for (const std::size_t vertices : {60U, 200U, 3000U}) {
      EXPECT_FALSE(is_odd(make_mesh(family, 2, vertices))) << family.name << ", " << vertices << " vertices";
    }
  }
  EXPECT_FALSE(is_odd(make_hubs(3000, 3000))) << "no edges";
  EXPECT_FALSE(is_odd(TestMesh{}));
}

TEST(VertexBfs, GraphsOfFewLinksOrOfLinksWithManyEdgesAreNotUnlikeASurface) {
  TestMesh path;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    path.add_vertex(i, 0, 0);
    if (i > 0) path.add_face({i - 1, i});
  }
  EXPECT_FALSE(is_odd(path.finish(true))) << "links of one edge, but few";
  EXPECT_FALSE(is_odd(make_random_graph(1000, 20'000))) << "many links, of many edges each";
}

TEST(VertexBfs, AnswersEveryBallWhereTheGraphIsUnlikeASurfaceOrHasNoEdgesOrSquaresUnderflow) {
  TestMesh vanishing = bumpy_grid(40);
  for (double& x : vanishing.positions) x *= 1e-160;
  for (const TestMesh& mesh : {make_hubs(2000, 3), make_random_graph(2000, 0), vanishing.finish(false)}) {
    const Index index = build(mesh.view());
    VertexBfs bfs(IndexAccess::view(index));
    EXPECT_TRUE(bfs.answers_all());
    EXPECT_FALSE(bfs.find(0, 0).empty());
    EXPECT_FALSE(bfs.find(0, kInfinity).empty());
  }
}

TEST(VertexBfs, LeavesAllBallsToTheSearchesOverLeavesWhereOneEdgeIsLeft) {
  TestMesh mesh = make_random_graph(100'000, 0);
  mesh.add_face({99'999, 7});
  const Index index = build(mesh.view());
  EXPECT_FALSE(VertexBfs(IndexAccess::view(index)).answers_all());
}

TEST(VertexBfs, AnswersSmallBallsOfASmallMeshOnceThereWereEnough) {
  const TestMesh mesh = bumpy_grid(40);
  const Index index = build(mesh.view());
  VertexBfs bfs(IndexAccess::view(index));
  EXPECT_FALSE(bfs.answers_all());
  for (std::size_t i = 0; i < mesh.size() / VertexBfs::kVerticesPerBall; ++i) EXPECT_TRUE(bfs.find(0, 1).empty());
  EXPECT_FALSE(bfs.find(0, 1).empty());
  EXPECT_TRUE(bfs.find(0, 30).empty());
}

TEST(VertexBfs, LeavesAllBallsOfALargeMeshToTheSearchesOverLeaves) {
  const TestMesh mesh = make_grid(257, 256, false);
  ASSERT_GT(mesh.size(), VertexBfs::kSmallMesh);
  const Index index = build(mesh.view());
  VertexBfs bfs(IndexAccess::view(index));
  bfs.record(0, 1, 1, 1);
  for (std::size_t i = 0; i < mesh.size(); ++i) ASSERT_TRUE(bfs.find(0, 0.5).empty());
}

/// That has made its copy of the graph.
VertexBfs prepared(const Index& index) {
  VertexBfs bfs(IndexAccess::view(index));
  for (std::size_t i = 0; i < index.vertex_count(); ++i) static_cast<void>(bfs.find(0, 0));
  return bfs;
}

constexpr VertexId kCenter = 20 * 40 + 20;  // of `bumpy_grid(40)`

TEST(VertexBfs, LearnsFromAnswersOverLeavesWhichBallsAreSmall) {
  const TestMesh mesh = bumpy_grid(40);
  const Index index = build(mesh.view());
  VertexBfs bfs = prepared(index);
  const double radius = 9;  // a quarter of a disk at the corner
  constexpr std::size_t kVisits = 10;
  constexpr std::size_t kMost = VertexBfs::kFewest + kVisits * VertexBfs::kByRows.vertices_per_leaf;
  EXPECT_THAT(bfs.find(0, radius), testing::IsEmpty());
  bfs.record(0, radius, kMost + 1, kVisits);
  EXPECT_THAT(bfs.find(0, radius), testing::IsEmpty());
  bfs.record(0, radius, kMost, kVisits);
  EXPECT_THAT(bfs.find(0, radius), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(bfs.find(kCenter, radius), testing::IsEmpty()) << "nothing is known of another leaf";
}

TEST(VertexBfs, LearnsFromItsOwnAnswersWhichBallsAreLarge) {
  const TestMesh mesh = bumpy_grid(40);
  const Index index = build(mesh.view());
  VertexBfs bfs = prepared(index);
  bfs.record(kCenter, 9, 2, 1);
  EXPECT_THAT(bfs.find(kCenter, 9), testing::Not(testing::IsEmpty())) << "found, although there are many";
  EXPECT_THAT(bfs.find(kCenter, 9), testing::IsEmpty()) << "not tried again";
  EXPECT_THAT(bfs.find(kCenter, 0), testing::SizeIs(1)) << "smaller balls are";
  bfs.record(kCenter, kInfinity, 2, 1);
  EXPECT_THAT(bfs.find(kCenter, kInfinity), testing::IsEmpty()) << "not completed";
}

TEST(VertexBfs, AsksTheSearchesOverLeavesAgainWhereTheRadiusIsAnother) {
  const TestMesh mesh = bumpy_grid(40);
  const Index index = build(mesh.view());
  VertexBfs bfs = prepared(index);
  bfs.record(kCenter, 30, mesh.size(), mesh.size());
  for (int i = 0; i < 3; ++i) EXPECT_THAT(bfs.find(kCenter, 20), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(bfs.find(kCenter, 14), testing::SizeIs(testing::Gt(VertexBfs::kByRows.vertices)));
  EXPECT_THAT(bfs.find(kCenter, 14), testing::IsEmpty());
}

TEST(VertexBfs, TakesFewerBallsForSmallWhereVerticesAreNotNumberedByRows) {
  const TestMesh grid = bumpy_grid(40);
  Random random(7);
  const TestMesh shuffled = renumbered(grid, random.permutation(grid.size()));
  const Index by_rows = build(grid.view());
  const Index in_any_order = build(shuffled.view());
  const auto largest = [](const Index& index) {
    VertexBfs bfs = prepared(index);
    double radius = 0;
    while (!bfs.expects_many(0, radius)) radius += 0.01;
    return radius;
  };
  EXPECT_LT(3 * largest(in_any_order), largest(by_rows));
}

TEST(VertexBfs, GridsAreNumberedByRowsAndShuffledOnesAreNot) {
  const TestMesh grid = bumpy_grid(40);
  Random random(7);
  const auto is_by_rows = [](const TestMesh& mesh) {
    const Adjacency graph = adjacency(mesh.view());
    return is_numbered_by_rows(graph.view());
  };
  EXPECT_TRUE(is_by_rows(grid));
  EXPECT_FALSE(is_by_rows(renumbered(grid, random.permutation(grid.size()))));
  EXPECT_FALSE(is_by_rows(TestMesh{}));
}

TEST(VertexBfs, RefusesWhatTheSearchesOverLeavesRefuse) {
  const TestMesh mesh = bumpy_grid(10);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  for (VertexId v = 0; v < mesh.size(); ++v) static_cast<void>(searcher.count(v, 0.5));
  const auto count = [&](VertexId v, double radius) {
    return [&, v, radius] { static_cast<void>(searcher.count(v, radius)); };
  };
  expect_refused(ErrorCode::VertexOutOfRange, "vertex 100, but the mesh has 100 vertices", count(100, 0.5));
  expect_refused(ErrorCode::InvalidRadius, "radius -0.5, expected a number >= 0", count(0, -0.5));
  expect_refused(ErrorCode::InvalidRadius, "radius nan, expected a number >= 0", count(0, std::nan("")));
}

void expect_small_balls(const Index& index, const TestMesh& mesh) {
  const Oracle oracle(mesh);
  Searcher searcher(index);
  for (VertexId v = 0; v < mesh.size(); ++v) expect_answers(searcher, oracle, v, 2.1);
  EXPECT_FALSE(SearcherAccess::state(searcher).vertex_bfs.find(0, 2.1).empty());
}

TEST(VertexBfs, FollowsTheVerticesAfterARefit) {
  const TestMesh before = bumpy_grid(12);
  TestMesh after = before;
  for (double& x : after.positions) x = 1.2 * std::round(x);
  after.finish(before.single_precision);
  std::vector<VertexId> all(before.size());
  std::iota(all.begin(), all.end(), 0U);
  Index index = build(before.view());
  expect_small_balls(index, before);
  expect_small_balls(refit(index, after.positions_view()), after);
  index = refit(std::move(index), after.positions_view(), all);
  expect_small_balls(index, after);
}

TEST(VertexBfs, AnswersOfALoadedAndOfAMappedIndexAreThoseOfTheOracle) {
  const TestMesh mesh = bumpy_grid(12);
  const std::vector<std::byte> bytes = saved(build(mesh.view()));
  Mappable place(bytes);
  expect_small_balls(load(bytes), mesh);
  expect_small_balls(map(place.bytes(), nullptr), mesh);
}

void compare_answers(const TestMesh& mesh, const Index& index) {
  const Oracle oracle(mesh);
  Searcher searcher(index);
  Random random(6);
  for (std::size_t i = 0; i < scaled(60, 10); ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    for (const double radius : {0.0, 0.3, 0.8, random.uniform(0, 2), kInfinity}) {
      expect_answers(searcher, oracle, v, radius);
    }
  }
}

TEST(VertexBfs, AnswersOfASearcherAroundHubsAreThoseOfTheOracle) {
  for (const std::size_t hubs : {1U, 20U}) {
    const TestMesh mesh = make_hubs(1500, hubs);
    compare_answers(mesh, build(mesh.view()));
  }
}

TEST(VertexBfs, AnswersOfAReorderedIndexAreInItsOwnOrder) {
  const TestMesh mesh = make_hubs(1500, 2);
  const ReorderedMesh reordered = reorder(mesh.view());
  TestMesh renamed = mesh;
  std::vector<std::uint32_t> place(mesh.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[reordered.permutation[i]] = static_cast<std::uint32_t>(i);
  compare_answers(renumbered(mesh, place), reordered.index);
}

TEST(VertexBfs, SearchersOfSeveralThreadsShareOneGraph) {
  const Index index = build(make_hubs(2000, 2).view());
  std::vector<const GraphData*> graphs(4);
  std::vector<std::thread> threads;
  for (const GraphData*& graph : graphs) {
    threads.emplace_back([&] { graph = &IndexAccess::view(index).graph->of(IndexAccess::view(index)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(graphs, testing::Each(graphs.front()));
}

}  // namespace
}  // namespace meshhood::test
