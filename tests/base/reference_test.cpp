// SPDX-License-Identifier: MIT
#include "meshhood/reference.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reference_access.h"
#include "support/families.h"
#include "support/oracle.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;

/// A U: its ends are near in space and far along it.
TestMesh horseshoe() {
  TestMesh mesh;
  for (const auto& [x, y] : {std::pair(0, 0), {5, 0}, {10, 0}, {10, 1}, {5, 1}, {0, 1}}) mesh.add_vertex(x, y, 0);
  for (std::uint32_t v = 1; v < 6; ++v) mesh.add_face({v - 1, v});
  return mesh.finish(true);
}

TEST(ExactNeighborhood, ExcludesNearVerticesThatAreNotConnected) {
  const TestMesh mesh = horseshoe();
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 1), ElementsAre(0));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 5), ElementsAre(0, 1));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 9.99), ElementsAre(0, 1));
  EXPECT_THAT(exact_neighborhood(mesh.view(), 0, 10.5), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Ball, IncludesNearVerticesThatAreNotConnected) {
  const TestMesh mesh = horseshoe();
  std::vector<VertexId> out;
  BallSearcher(mesh.positions_view()).neighborhood(0, 1, out);
  EXPECT_THAT(out, ElementsAre(0, 5));
}

TEST(ReferenceSearcher, ReturnsTheVertexFirstAndNoDuplicates) {
  const TestMesh mesh = make_grid(20, 20, false);
  ReferenceSearcher searcher(mesh.view());
  std::vector<VertexId> out;
  for (VertexId v = 0; v < mesh.size(); v += 13) {
    searcher.neighborhood(v, 5, out);
    EXPECT_EQ(out.front(), v);
    EXPECT_EQ(std::set<VertexId>(out.begin(), out.end()).size(), out.size());
  }
}

TEST(ReferenceSearcher, AGraphGivesTheAnswersOfItsMesh) {
  const TestMesh mesh = make_grid(20, 20, false);
  const Adjacency graph = adjacency(mesh.view());
  ReferenceSearcher of_mesh(mesh.view());
  ReferenceSearcher of_graph(GraphView{mesh.positions_view(), graph.view()});
  EXPECT_TRUE(std::ranges::equal(of_mesh.adjacency().neighbors, graph.neighbors));
  std::vector<VertexId> a;
  std::vector<VertexId> b;
  for (VertexId v = 0; v < mesh.size(); ++v) {
    of_mesh.neighborhood(v, 4, a);
    of_graph.neighborhood(v, 4, b);
    ASSERT_EQ(a, b);
  }
}

TEST(ReferenceSearcher, CanBeMoved) {
  const TestMesh mesh = make_grid(5, 5, false);
  ReferenceSearcher first(mesh.view());
  ReferenceSearcher second(std::move(first));
  first = std::move(second);
  std::vector<VertexId> out;
  first.neighborhood(12, 1, out);
  EXPECT_EQ(out.size(), 5U);
}

TEST(ReferenceSearcher, AnswersStayTheSameWhenTheQueryNumberWrapsAround) {
  const TestMesh mesh = make_grid(20, 20, false);
  ReferenceSearcher searcher(mesh.view());
  std::vector<VertexId> expected;
  std::vector<VertexId> out;
  for (int i = 0; i < 10; ++i) searcher.neighborhood(210, 5, expected);
  ReferenceAccess::set_query(searcher, std::numeric_limits<std::uint32_t>::max() - 5);
  for (int i = 0; i < 15; ++i) {
    searcher.neighborhood(210, 5, out);
    EXPECT_EQ(out, expected) << "query " << i;
  }
}

TEST(Ball, EqualsTheOracle) {
  std::size_t queries = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 1; seed < scaled(20, 3); ++seed) {
      const TestMesh mesh = make_mesh(family, seed, 20 * seed);
      const Oracle oracle(mesh);
      Random random(seed);
      std::vector<VertexId> out;
      for (int i = 0; mesh.size() > 0 && i < 50; ++i, ++queries) {
        const auto v = static_cast<std::uint32_t>(random.below(mesh.size()));
        const double tie = oracle.distance(v, random.below(mesh.size()));
        BallSearcher(mesh.positions_view()).neighborhood(static_cast<VertexId>(v), tie, out);
        ASSERT_TRUE(std::ranges::equal(out, oracle.ball(v, tie))) << mesh.name << ", radius " << tie;
      }
    }
  }
  std::printf("%zu queries, 0 mismatches\n", queries);
}

TEST(ReferenceSearcher, ALargerRadiusGivesASuperset) {
  for (const Family& family : families()) {
    const TestMesh mesh = make_mesh(family, 3, 200);
    if (mesh.size() == 0) continue;
    const Oracle oracle(mesh);
    ReferenceSearcher searcher(mesh.view());
    std::vector<double> radii{0, kInfinity};
    for (std::size_t w = 0; w < mesh.size(); w += 5) radii.push_back(oracle.distance(0, w));
    std::sort(radii.begin(), radii.end());
    std::vector<VertexId> smaller;
    std::vector<VertexId> out;
    for (const double radius : radii) {
      searcher.neighborhood(0, radius, out);
      std::sort(out.begin(), out.end());
      ASSERT_TRUE(std::ranges::includes(out, smaller)) << mesh.name << ", radius " << radius;
      std::swap(smaller, out);
    }
  }
}

TEST(Reference, InvalidArgumentsAreRefusedAndResultsStayUnchanged) {
  const TestMesh mesh = make_grid(3, 3, false);
  ReferenceSearcher searcher(mesh.view());
  std::vector<VertexId> out{1, 2};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto exact = [&](VertexId v, double r) { return [&, v, r] { searcher.neighborhood(v, r, out); }; };
  const auto scan = [&](VertexId v, double r) {
    return [&, v, r] { BallSearcher(mesh.positions_view()).neighborhood(v, r, out); };
  };
  const auto once = [&](VertexId v, double r) {
    return [&, v, r] { static_cast<void>(exact_neighborhood(mesh.view(), v, r)); };
  };
  const auto expect_all_refused = [&](ErrorCode code, const char* cause, VertexId v, double r) {
    expect_refused(code, cause, exact(v, r));
    expect_refused(code, cause, scan(v, r));
    expect_refused(code, cause, once(v, r));
  };
  expect_all_refused(ErrorCode::VertexOutOfRange, "vertex 9, but the mesh has 9 vertices", 9, 1);
  expect_all_refused(ErrorCode::VertexOutOfRange, "but the mesh has 9 vertices", static_cast<VertexId>(-1), 1);
  expect_all_refused(ErrorCode::InvalidRadius, "radius nan, expected a number >= 0", 0, nan);
  expect_all_refused(ErrorCode::InvalidRadius, "radius -0.5, expected a number >= 0", 0, -0.5);
  expect_all_refused(ErrorCode::InvalidRadius, "radius -inf, expected a number >= 0", 0, -kInfinity);
  EXPECT_THAT(out, ElementsAre(1, 2));
}

TEST(Reference, RadiusMayBeMinusZeroOrInfinite) {
  const TestMesh mesh = make_grid(3, 3, false);
  EXPECT_THAT(exact_neighborhood(mesh.view(), 4, -0.0), ElementsAre(4));
  EXPECT_EQ(exact_neighborhood(mesh.view(), 4, kInfinity).size(), 9U);
}

}  // namespace
}  // namespace meshhood::test
