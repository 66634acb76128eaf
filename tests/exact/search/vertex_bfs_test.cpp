// SPDX-License-Identifier: MIT
// The graphs on which a searcher searches over vertices, and its answers there.
#include "exact/search/vertex_bfs.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/reorder.h"

#include "support/family_name.h"
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

class VertexBfsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(VertexBfsOnFamilies, FindsTheRangesOfTheNeighborhood) {
  std::size_t queries = 0;
  for (std::uint64_t seed = 0; seed < scaled(10, 2); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    VertexBfs bfs(index);
    Random random(seed);
    for (int i = 0; i < 5; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        Ids ids;
        std::size_t end = 0;
        for (const VertexRange& range : bfs.ranges(v, radius)) {
          ASSERT_TRUE(ids.empty() || range.begin > end) << "ranges ascend and do not touch";
          ASSERT_LT(range.begin, range.end);
          end = range.end;
          for (std::size_t at = range.begin; at < end; ++at) ids.push_back(index.permutation()[at]);
        }
        ASSERT_EQ(sorted(ids), oracle.exact(v, radius)) << mesh.name << ": vertex " << v << ", radius " << radius;
        ++queries;
      }
    }
  }
  std::printf("%zu queries\n", queries);
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

TEST(VertexBfs, SearchersUseItWhereTheGraphIsUnlikeASurface) {
  const Index odd = build(make_hubs(2000, 3).view());
  const Index surface = build(bumpy_grid(40).view());
  Searcher on_odd(odd);
  Searcher on_surface(surface);
  EXPECT_TRUE(SearcherAccess::state(on_odd).vertex_bfs.has_value());
  EXPECT_FALSE(SearcherAccess::state(on_surface).vertex_bfs.has_value());
}

/// Compares every kind of answer of a plain searcher with the oracle.
void compare_answers(const TestMesh& mesh, const Index& index) {
  const Oracle oracle(mesh);
  Searcher searcher(index);
  Random random(6);
  Ids ids;
  std::vector<double> distances;
  for (std::size_t i = 0; i < scaled(60, 10); ++i) {
    const auto v = static_cast<VertexId>(random.below(mesh.size()));
    for (const double radius : {0.0, 0.3, 0.8, random.uniform(0, 2), std::numeric_limits<double>::infinity()}) {
      const Ids expected = oracle.exact(v, radius);
      searcher.neighborhood(v, radius, ids, distances);
      for (std::size_t k = 0; k < ids.size(); ++k) ASSERT_EQ(distances[k], oracle.distance(v, ids[k]));
      ASSERT_EQ(sorted(ids), expected);
      searcher.neighborhood(v, radius, ids);
      ASSERT_EQ(sorted(ids), expected);
      ASSERT_EQ(searcher.count(v, radius), expected.size());
      std::size_t in_ranges = 0;
      for (const VertexRange& range : searcher.ranges(v, radius)) in_ranges += range.end - range.begin;
      ASSERT_EQ(in_ranges, expected.size());
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
    threads.emplace_back([&] { graph = &IndexAccess::view(index).graph->of(index); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(graphs, testing::Each(graphs.front()));
}

}  // namespace
}  // namespace meshhood::test
