// SPDX-License-Identifier: MIT
// The graph of near points, against a scan of all pairs.
#include "meshhood/link_points.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "support/families.h"
#include "support/family_name.h"
#include "support/oracle.h"
#include "support/random.h"
#include "support/refusal.h"
#include "support/same_storage.h"

namespace meshhood::test {
namespace {

Adjacency scan(const Oracle& oracle, double link) {
  Adjacency graph{{0}, {}};
  for (std::size_t v = 0; v < oracle.size(); ++v) {
    for (std::size_t w = 0; w < oracle.size(); ++w) {
      if (v != w && oracle.distance(v, w) <= link) graph.neighbors.push_back(static_cast<VertexId>(w));
    }
    graph.offsets.push_back(static_cast<EdgeOffset>(graph.neighbors.size()));
  }
  return graph;
}

/// Compares the graph of the mesh's vertices with a scan of all pairs. Returns the number of edges.
std::size_t expect_scanned(const TestMesh& mesh, const Oracle& oracle, double link) {
  const Adjacency expected = scan(oracle, link);
  const Adjacency found = link_points(mesh.positions_view(), link, {}, {.threads = 2});
  EXPECT_EQ(found.offsets, expected.offsets) << "link " << link;
  EXPECT_EQ(found.neighbors, expected.neighbors) << "link " << link;
  return found.neighbors.size() / 2;
}

MESHHOOD_SUITE_OF_FAMILIES(LinkedFamilies);

TEST_P(LinkedFamilies, JoinThePairsOfAScan) {
  std::size_t edges = 0;
  for (const std::size_t vertices : {1U, 40U, 300U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    SCOPED_TRACE(mesh.name);
    const Oracle oracle(mesh);
    Random random(vertices);
    const auto pick = [&] { return random.below(mesh.size()); };
    const double edge = oracle.mean_edge();
    for (const double link : {0.0, 0.9 * edge, 2 * edge, mesh.size() == 0 ? 0 : oracle.distance(pick(), pick())}) {
      edges += expect_scanned(mesh, oracle, link);
    }
  }
  std::printf("%s: %zu edges\n", std::string(GetParam().name).c_str(), edges);
}

TEST(LinkPoints, OfAClusterAndAnOutlierDoNotLookAtAllPairs) {
  std::vector<double> points;
  for (int i = 0; i < 300000; ++i) points.insert(points.end(), {static_cast<double>(i), 0, 0});
  points.resize(points.size() + 3);
  for (const double far : {1e13, 0x1p60}) {
    std::fill(points.end() - 3, points.end(), far);
    const Adjacency graph = link_points(points, 1.5);
    EXPECT_EQ(graph.neighbors.size(), 2U * 299999U);
    EXPECT_EQ(graph.view()[300000].size(), 0U);
  }
}

// Where cells must be wider than the link for the sake of one point, all others would share one.
TEST(LinkPoints, OfClustersAndPointsVeryFarAwayAreThoseOfAScan) {
  Random random(9);
  TestMesh mesh;
  for (int i = 0; i < 600; ++i) {
    const double base = i % 3 == 0 ? 0 : i % 3 == 1 ? 40 : -1e6;
    mesh.add_vertex(base + random.uniform(0, 12), random.uniform(0, 12), base + random.uniform(0, 3));
  }
  for (const double far : {0x1p60, -0x1p70, 0x1p300}) mesh.add_vertex(far, 3, far);
  const Oracle oracle(mesh.finish(false));
  for (const double link : {0.0, 1.0, 3.0}) expect_scanned(mesh, oracle, link);
}

TEST(LinkPoints, AcrossMoreCellsThanKeys) {
  // 2^40 cells along each axis, whose keys are not distinct.
  Random random(7);
  TestMesh mesh;
  mesh.add_vertex(0x1p40, 0x1p40, 0x1p40);
  for (int i = 0; i < 2000; ++i) {
    const double base = i % 2 == 0 ? 0 : 0x1p39;
    const auto draw = [&] { return base + random.uniform(0, 12); };
    mesh.add_vertex(draw(), draw(), draw());
  }
  EXPECT_GT(expect_scanned(mesh.finish(false), Oracle(mesh), 1), 0U);
}

TEST(LinkPoints, OfCellsThatShareAKeyAreJoinedOnce) {
  // 2^32 keys along two axes: the cells that follow each other along the first one have the same key.
  constexpr double kCells = 0x1p32 - 2.5;
  constexpr double kExtent = kCells / (1 - kCells * 0x1p-50);
  TestMesh mesh;
  Random random(8);
  mesh.add_vertex(0, kExtent, kExtent);
  for (int i = 0; i < 500; ++i) mesh.add_vertex(random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9));
  EXPECT_GT(expect_scanned(mesh.finish(false), Oracle(mesh), 1), 0U);
}

TEST(LinkPoints, BuildTheIndexOfTheirGraph) {
  const TestMesh mesh = bumpy_grid(40);
  const Adjacency graph = link_points(mesh.positions_view(), 1.2);
  const Index expected = build(GraphView{mesh.positions_view(), graph.view()});
  EXPECT_THAT(differences(build_linked(mesh.positions_view(), 1.2, {}, {.threads = 2}), expected), testing::IsEmpty());
}

TEST(LinkPoints, RefuseWrongLinksAndTooManyEdges) {
  std::vector<float> points;
  for (int i = 0; i < 3000; ++i) points.insert(points.end(), {static_cast<float>(i % 10), 0, 0});
  expect_refused(ErrorCode::InvalidOption, "link: -1", [&] { return link_points(points, -1); });
  expect_refused(ErrorCode::InvalidOption, "link: inf",
                 [&] { return link_points(points, std::numeric_limits<double>::infinity()); });
  expect_refused(ErrorCode::TooLarge, "link: 20 joins the 3000 points by more than 1000 edges",
                 [&] { return link_points(points, 20, {.max_edges = 1000}); });
  const std::size_t edges = std::size_t{3000} * 2999 / 2;
  EXPECT_EQ(link_points(points, 20, {.max_edges = edges}).neighbors.size(), 2 * edges);
  expect_refused(ErrorCode::TooLarge, "edges",
                 [&] { return link_points(points, 20, {.max_edges = edges - 1}, {.threads = 2}); });
  points[4] = std::numeric_limits<float>::quiet_NaN();
  expect_refused(ErrorCode::InvalidMesh, "vertex 1", [&] { return link_points(points, 1); });
}

}  // namespace
}  // namespace meshhood::test
