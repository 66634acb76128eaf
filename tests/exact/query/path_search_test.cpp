// SPDX-License-Identifier: MIT
// Path searches on graphs whose edges have very different lengths: the lengths of the paths, and the number of steps.
#include "exact/query/path_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"

#include "exact/index_access.h"
#include "support/draw_start.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/region_oracle.h"

namespace meshhood::test {
namespace {

/// Searches from vertex 0 and compares with the oracle. Returns the steps for each vertex found.
double steps_for_each_vertex(TestMesh mesh) {
  const Index built = build(mesh.finish(false).view());
  const IndexView& index = IndexAccess::view(built);
  PathSearch search(index, *IndexAccess::share_graph(built));
  search.run(index.place(0), kInfinity);
  const RegionOracle oracle(mesh);
  const PlainStart start{.center = position(mesh, 0), .seeds = {0}, .walls = std::vector<std::uint8_t>(mesh.size())};
  const std::vector<double> expected = oracle.path_lengths(
      start, kInfinity, [&](std::uint32_t v, std::uint32_t w) { return oracle.graph().distance(v, w); });
  const auto reachable = std::ranges::count_if(expected, [](double length) { return length < kInfinity; });
  EXPECT_EQ(search.found().size(), static_cast<std::size_t>(reachable));
  double last = 0;
  for (const Path& path : search.found_in_order()) {
    EXPECT_EQ(path.length, expected[index.id(path.end)]);
    EXPECT_GE(path.length, last);
    last = path.length;
  }
  return static_cast<double>(search.steps()) / static_cast<double>(search.found().size());
}

/// The vertices of a line, a unit apart, and its edges.
TestMesh make_line(std::uint32_t vertices) {
  TestMesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.add_vertex(i, 0, 0);
    if (i > 0) mesh.add_face({i - 1, i});
  }
  return mesh.finish(false);
}

/// Vertices on a line, which `hubs` hubs reach: the later a hub is met, the shorter are the paths over it. An edge of
/// length `far` at the first vertex makes the buckets wide.
TestMesh make_hubs(std::size_t hubs, double far) {
  TestMesh graph;
  const VertexId start = graph.add_vertex(0, 0, 0);
  graph.add_face({start, graph.add_vertex(0, -far, 0)});
  std::vector<VertexId> line;
  for (int i = 0; i < 200; ++i) line.push_back(graph.add_vertex(1 + 1e-4 * i, 0, 0));
  VertexId last = start;
  for (std::size_t k = 1; k <= hubs; ++k) {
    const VertexId step = graph.add_vertex(0, -1e-4 * static_cast<double>(k), 0);
    graph.add_face({last, step});
    const VertexId hub = graph.add_vertex(0.5, 2 - static_cast<double>(k) / static_cast<double>(hubs), 0);
    graph.add_face({step, hub});
    for (const VertexId v : line) graph.add_face({hub, v});
    last = step;
  }
  return graph;
}

TEST(PathSearch, FollowsEachVertexFewTimesWhateverTheLengthsOfTheEdges) {
  for (const double far : {0.0, 1.0, 1e3, 1e9, 1e100}) {
    SCOPED_TRACE(far);
    EXPECT_LE(steps_for_each_vertex(make_hubs(40, far)), PathSearch::kRounds + 1);
  }
}

TEST(PathSearch, FollowsEachVertexOnceIfTheBucketsAreNarrow) { EXPECT_EQ(steps_for_each_vertex(make_line(200)), 1); }

TEST(PathSearch, IsExactForLengthsThatGrowExponentially) {
  TestMesh graph;
  for (int i = 0; i < 900; ++i) graph.add_vertex(std::ldexp(1, i - 450), i % 2 == 0 ? 0 : std::ldexp(1, i - 451), 0);
  for (VertexId i = 1; i < 900; ++i) graph.add_face({i - 1, i});
  for (VertexId i = 3; i < 900; ++i) graph.add_face({i - 3, i});
  EXPECT_LE(steps_for_each_vertex(graph), PathSearch::kRounds + 1);
}

TEST(PathSearch, IsExactForEdgesOfLengthZeroAndDenormalPositions) {
  for (const double unit : {0.0, 1e-310, 1e-170, 1e-160}) {
    SCOPED_TRACE(unit);
    Random random(3);
    TestMesh graph;
    for (int i = 0; i < 300; ++i) graph.add_vertex(unit * random.uniform(0, 1), unit * random.uniform(0, 1), 0);
    for (VertexId i = 1; i < 300; ++i) graph.add_face({static_cast<VertexId>(random.below(i)), i});
    EXPECT_LE(steps_for_each_vertex(graph), PathSearch::kRounds + 1);
  }
}

TEST(PathSearch, SearchesAgainFromOtherVerticesAndBehindOtherWalls) {
  const auto [line, built] = indexed(make_line(10));
  const IndexView& index = IndexAccess::view(built);
  std::vector<std::uint8_t> walls(10);
  walls[4] = 1;
  const Index with_walls = masked(built, {.walls = walls});
  PathSearch search(index, *IndexAccess::share_graph(built));
  PathSearch between_walls(IndexAccess::view(with_walls), *IndexAccess::share_graph(built));
  const auto count = [&](PathSearch& by, VertexId v) {
    by.run(index.place(v), 20);
    return by.found().size();
  };
  EXPECT_EQ(count(between_walls, 0), 4U);
  EXPECT_EQ(count(search, 0), 10U);
  EXPECT_EQ(count(between_walls, 9), 5U);
  EXPECT_EQ(count(between_walls, 4), 0U);
  EXPECT_EQ(count(search, 4), 10U);
}

TEST(PathSearch, FindsTheShortestPathsFromAnyOfSeveralVertices) {
  const auto [line, built] = indexed(make_line(10));
  const IndexView& index = IndexAccess::view(built);
  PathSearch search(index, *IndexAccess::share_graph(built));
  const auto run = [&](std::vector<Path> starts) {  // of vertices
    for (Path& start : starts) start.end = index.place(start.end);
    search.run(std::span<const Path>(starts), 3, [](std::span<const Path>) { return false; });
  };
  run({{0, 1}, {0, 8}, {0, 1}});
  EXPECT_EQ(search.found().size(), 10U);
  for (const Path& path : search.found()) {
    const auto x = static_cast<int>(index.id(path.end));
    EXPECT_EQ(path.length, std::min(std::abs(x - 1), std::abs(x - 8)));
  }
  run({{2.5, 1}, {1.5, 8}, {2, 1}, {3.5, 4}, {4, 8}});
  std::vector<VertexId> ids;
  for (const Path& path : search.found_in_order()) {
    const auto x = static_cast<int>(index.id(path.end));
    ids.push_back(index.id(path.end));
    EXPECT_EQ(path.length, std::min(2.0 + std::abs(x - 1), 1.5 + std::abs(x - 8)));
  }
  EXPECT_EQ(ids.front(), 8U);
  EXPECT_EQ(std::set(ids.begin(), ids.end()), (std::set<VertexId>{0, 1, 2, 7, 8, 9}));
  EXPECT_EQ(ids.size(), 6U);
  run({});
  EXPECT_TRUE(search.found_in_order().empty());
}

}  // namespace
}  // namespace meshhood::test
