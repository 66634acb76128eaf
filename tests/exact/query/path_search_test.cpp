// SPDX-License-Identifier: MIT
// Path searches on graphs whose edges have very different lengths: the lengths of the paths, and the number of steps.
#include "exact/query/path_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/masks.h"

#include "exact/index_access.h"
#include "shared/distance.h"
#include "support/random.h"

namespace meshhood::test {
namespace {

/// A graph in the plane.
struct PlaneGraph {
  std::vector<double> positions;  // #V by 3
  std::vector<std::pair<VertexId, VertexId>> edges;

  [[nodiscard]] std::size_t size() const { return positions.size() / 3; }

  VertexId add(double x, double y) {
    positions.insert(positions.end(), {x, y, 0});
    return static_cast<VertexId>(size() - 1);
  }

  void join(VertexId a, VertexId b) { edges.emplace_back(a, b); }

  [[nodiscard]] double length(VertexId a, VertexId b) const {
    const Point p{positions[3 * a], positions[3 * a + 1], 0};
    const Point q{positions[3 * b], positions[3 * b + 1], 0};
    return std::sqrt(squared_distance(p, q));
  }

  [[nodiscard]] Index index() const {
    std::vector<std::vector<VertexId>> rows(size());
    for (const auto& [a, b] : edges) {
      rows[a].push_back(b);
      rows[b].push_back(a);
    }
    Adjacency adjacency;
    adjacency.offsets.push_back(0);
    for (std::vector<VertexId>& row : rows) {
      std::sort(row.begin(), row.end());
      adjacency.neighbors.insert(adjacency.neighbors.end(), row.begin(), row.end());
      adjacency.offsets.push_back(static_cast<EdgeOffset>(adjacency.neighbors.size()));
    }
    return build(GraphView{PositionsView(positions), adjacency.view()});
  }

  /// The path distances from vertex 0, by relaxing all edges until nothing changes.
  [[nodiscard]] std::vector<double> distances() const {
    std::vector<double> least(size(), std::numeric_limits<double>::infinity());
    least[0] = 0;
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const auto& [a, b] : edges) {
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
          const double through = least[from] + length(from, to);
          if (!(through < least[to])) continue;
          least[to] = through;
          has_changed = true;
        }
      }
    }
    return least;
  }
};

/// Searches from vertex 0 and compares with the plain search. Returns the steps for each vertex found.
double steps_for_each_vertex(const PlaneGraph& graph) {
  const Index built = graph.index();
  const IndexView& index = IndexAccess::view(built);
  PathSearch search(index, *IndexAccess::share_graph(built));
  const std::uint32_t slot = index.slot[0];
  search.run(index.leaf_begin[leaf_of(slot)] + lane_of(slot), std::numeric_limits<double>::infinity());
  const std::vector<double> expected = graph.distances();
  std::size_t reachable = 0;
  for (const double length : expected) reachable += std::isfinite(length) ? 1 : 0;
  EXPECT_EQ(search.found().size(), reachable);
  double last = 0;
  for (const Path& path : search.found_in_order()) {
    EXPECT_EQ(path.length, expected[index.id(path.end)]);
    EXPECT_GE(path.length, last);
    last = path.length;
  }
  return static_cast<double>(search.steps()) / static_cast<double>(search.found().size());
}

/// Vertices on a line, which `hubs` hubs reach: the later a hub is met, the shorter are the paths over it. An edge of
/// length `far` at the first vertex makes the buckets wide.
PlaneGraph make_hubs(std::size_t hubs, double far) {
  PlaneGraph graph;
  const VertexId start = graph.add(0, 0);
  graph.join(start, graph.add(0, -far));
  std::vector<VertexId> line;
  for (int i = 0; i < 200; ++i) line.push_back(graph.add(1 + 1e-4 * i, 0));
  VertexId last = start;
  for (std::size_t k = 1; k <= hubs; ++k) {
    const VertexId step = graph.add(0, -1e-4 * static_cast<double>(k));
    graph.join(last, step);
    const VertexId hub = graph.add(0.5, 2 - static_cast<double>(k) / static_cast<double>(hubs));
    graph.join(step, hub);
    for (const VertexId v : line) graph.join(hub, v);
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

TEST(PathSearch, FollowsEachVertexOnceIfTheBucketsAreNarrow) {
  PlaneGraph graph;
  for (int i = 0; i < 200; ++i) graph.add(i, 0);
  for (VertexId i = 1; i < 200; ++i) graph.join(i - 1, i);
  EXPECT_EQ(steps_for_each_vertex(graph), 1);
}

TEST(PathSearch, IsExactForLengthsThatGrowExponentially) {
  PlaneGraph graph;
  for (int i = 0; i < 900; ++i) graph.add(std::ldexp(1, i - 450), i % 2 == 0 ? 0 : std::ldexp(1, i - 451));
  for (VertexId i = 1; i < 900; ++i) graph.join(i - 1, i);
  for (VertexId i = 3; i < 900; ++i) graph.join(i - 3, i);
  EXPECT_LE(steps_for_each_vertex(graph), PathSearch::kRounds + 1);
}

TEST(PathSearch, IsExactForEdgesOfLengthZeroAndDenormalPositions) {
  for (const double unit : {0.0, 1e-310, 1e-170, 1e-160}) {
    SCOPED_TRACE(unit);
    Random random(3);
    PlaneGraph graph;
    for (int i = 0; i < 300; ++i) graph.add(unit * random.uniform(0, 1), unit * random.uniform(0, 1));
    for (VertexId i = 1; i < 300; ++i) graph.join(static_cast<VertexId>(random.below(i)), i);
    EXPECT_LE(steps_for_each_vertex(graph), PathSearch::kRounds + 1);
  }
}

TEST(PathSearch, SearchesAgainFromOtherVerticesAndBehindOtherWalls) {
  PlaneGraph graph;
  for (int i = 0; i < 10; ++i) graph.add(i, 0);
  for (VertexId i = 1; i < 10; ++i) graph.join(i - 1, i);
  const Index built = graph.index();
  const IndexView& index = IndexAccess::view(built);
  std::vector<std::uint8_t> walls(10);
  walls[4] = 1;
  const Index with_walls = masked(built, {.walls = walls});
  PathSearch search(index, *IndexAccess::share_graph(built));
  PathSearch between_walls(IndexAccess::view(with_walls), *IndexAccess::share_graph(built));
  const auto count = [&](PathSearch& by, VertexId v) {
    const std::uint32_t slot = index.slot[v];
    by.run(index.leaf_begin[leaf_of(slot)] + lane_of(slot), 20);
    return by.found().size();
  };
  EXPECT_EQ(count(between_walls, 0), 4U);
  EXPECT_EQ(count(search, 0), 10U);
  EXPECT_EQ(count(between_walls, 9), 5U);
  EXPECT_EQ(count(between_walls, 4), 0U);
  EXPECT_EQ(count(search, 4), 10U);
}

TEST(PathSearch, FindsTheShortestPathsFromAnyOfSeveralVertices) {
  PlaneGraph graph;
  for (int i = 0; i < 10; ++i) graph.add(i, 0);
  for (VertexId i = 1; i < 10; ++i) graph.join(i - 1, i);
  const Index built = graph.index();
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
