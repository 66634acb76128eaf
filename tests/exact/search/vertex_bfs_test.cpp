// SPDX-License-Identifier: MIT
// Which indexes are searched over vertices, and the answers there.
#include "exact/search/vertex_bfs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/refit.h"
#include "meshhood/reorder.h"
#include "meshhood/serialize.h"

#include "shared/distance.h"
#include "support/family_name.h"
#include "support/index_bytes.h"
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

bool is_unlike(const TestMesh& mesh) {
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

MESHHOOD_SUITE_OF_FAMILIES(VertexBfsOnFamilies);

TEST_P(VertexBfsOnFamilies, FindsTheNeighborhoodInIndexOrder) {
  std::size_t queries = 0;
  for (std::uint64_t seed = 0; seed < scaled(10, 2); ++seed) {
    const TestMesh mesh = make_mesh(GetParam(), seed, 300);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    const Index index = build(mesh.view());
    const IndexView& view = IndexAccess::view(index);
    VertexBfs bfs(view, *IndexAccess::share_graph(index));
    VertexSet answer(view);
    Random random(seed);
    for (int i = 0; i < 5; ++i) {
      const auto v = static_cast<VertexId>(random.below(mesh.size()));
      for (const double radius : draw_radii(random, oracle, v)) {
        answer.clear();
        bfs.run(v, squared_radius(radius), answer);
        Ids found;
        std::size_t next = 0;
        answer.for_each([&](std::size_t w) {
          ASSERT_GE(w, next) << "not in index order";
          next = w + 1;
          found.push_back(view.id(w));
        });
        ASSERT_EQ(sorted(found), oracle.exact(v, radius)) << mesh.name << ": vertex " << v << ", radius " << radius;
        ++queries;
      }
    }
  }
  std::printf("%zu queries\n", queries);
}

TEST(VertexBfs, HubsAndRandomGraphsAreUnlikeASurface) {
  for (const std::size_t hubs : {1U, 20U, 60U}) EXPECT_TRUE(is_unlike(make_hubs(6000, hubs))) << hubs << " hubs";
  for (const std::size_t degree : {2U, 6U, 20U}) {
    EXPECT_TRUE(is_unlike(make_random_graph(20'000, 10'000 * degree))) << "degree " << degree;
  }
}

TEST(VertexBfs, ACombIsUnlikeASurface) {
  const std::vector<Family> all = families();
  const auto far_away = std::find_if(all.begin(), all.end(), [](const Family& f) { return f.name == "far away"; });
  ASSERT_NE(far_away, all.end());
  EXPECT_TRUE(is_unlike(make_mesh(*far_away, 1, 20'000))) << "a link of one edge for every four vertices";
}

TEST(VertexBfs, SurfacesAndGraphsWithoutEdgesAreNotUnlikeASurface) {
  for (const Family& family : surface_families()) {
    for (const std::size_t vertices : {60U, 200U, 3000U}) {
      EXPECT_FALSE(is_unlike(make_mesh(family, 2, vertices))) << family.name << ", " << vertices << " vertices";
    }
  }
  EXPECT_FALSE(is_unlike(make_hubs(3000, 3000))) << "no edges";
  EXPECT_FALSE(is_unlike(TestMesh{}));
}

TEST(VertexBfs, GraphsOfFewLinksOrOfLinksWithManyEdgesAreNotUnlikeASurface) {
  TestMesh path;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    path.add_vertex(i, 0, 0);
    if (i > 0) path.add_face({i - 1, i});
  }
  EXPECT_FALSE(is_unlike(path.finish(true))) << "links of one edge, but few";
  EXPECT_FALSE(is_unlike(make_random_graph(1000, 20'000))) << "many links, of many edges each";
}

TEST(VertexBfs, AnswersEveryQueryWhereTheGraphIsUnlikeASurfaceOrHasNoEdgesOrSquaresUnderflow) {
  TestMesh vanishing = bumpy_grid(40);
  for (double& x : vanishing.positions) x *= 1e-160;
  for (const TestMesh& mesh : {make_hubs(2000, 3), make_random_graph(2000, 0), vanishing.finish(false)}) {
    const Index index = build(mesh.view());
    EXPECT_TRUE(is_odd(IndexAccess::view(index)));
    Searcher searcher(index);
    for (const double radius : {0.0, 1e-161, 0.1, kInfinity}) {
      EXPECT_GE(searcher.count(0, radius), 1U);
      EXPECT_EQ(SearcherAccess::state(searcher).way, SearcherAccess::State::Way::VertexBfs);
    }
  }
}

TEST(VertexBfs, LeavesGraphsOfOneEdgeAndSurfacesToTheSearchesOverLeaves) {
  TestMesh mesh = make_random_graph(100'000, 0);
  mesh.add_face({99'999, 7});
  const Index index = build(mesh.view());
  EXPECT_FALSE(is_odd(IndexAccess::view(index)));
  const Index grid = build(bumpy_grid(40).view());
  EXPECT_FALSE(is_odd(IndexAccess::view(grid)));
  const Index none = build(TestMesh{}.view());
  EXPECT_FALSE(is_odd(IndexAccess::view(none)));
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
  std::vector<std::uint32_t> place(mesh.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[reordered.permutation[i]] = static_cast<std::uint32_t>(i);
  compare_answers(renumbered(mesh, place), reordered.index);
}

TEST(VertexBfs, FollowsTheVerticesAfterARefit) {
  const TestMesh before = make_hubs(1500, 2);
  TestMesh after = before;
  for (double& x : after.positions) x = std::round(3 * x) / 3;
  after.finish(before.single_precision);
  std::vector<VertexId> all(before.size());
  std::iota(all.begin(), all.end(), 0U);
  Index index = build(before.view());
  compare_answers(before, index);
  compare_answers(after, refit(index, after.positions_view()));
  index.refit_in_place(after.positions_view(), all);
  compare_answers(after, index);
}

TEST(VertexBfs, AnswersOfALoadedAndOfAMappedIndexAreThoseOfTheOracle) {
  const TestMesh mesh = make_hubs(1500, 2);
  const std::vector<std::byte> bytes = saved(build(mesh.view()));
  Mappable place(bytes);
  compare_answers(mesh, load(bytes));
  compare_answers(mesh, map(place.bytes(), nullptr));
}

TEST(VertexBfs, SearchersOfSeveralThreadsShareOneGraph) {
  const Index index = build(make_hubs(2000, 2).view());
  std::vector<const WeightedGraph*> graphs(4);
  std::vector<std::thread> threads;
  for (const WeightedGraph*& graph : graphs) {
    threads.emplace_back([&] { graph = &IndexAccess::share_graph(index)->paths_of(IndexAccess::view(index)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(graphs, testing::Each(graphs.front()));
}

}  // namespace
}  // namespace meshhood::test
