// SPDX-License-Identifier: MIT
#include "meshhood/adjacency.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/families.h"
#include "support/oracle.h"
#include "support/refusal.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Adjacency, ConsecutiveCornersAreNeighbors) {
  const TestMesh mesh = make_grid(2, 2, true);  // 0 1 / 2 3
  const Adjacency graph = adjacency(mesh.view());
  EXPECT_THAT(graph.offsets, ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(graph.neighbors, ElementsAre(1, 2, 0, 3, 0, 3, 1, 2));
}

TEST(Adjacency, AnEmptyMeshIsAccepted) {
  EXPECT_THAT(adjacency(MeshView{}).offsets, ElementsAre(0));
  const Adjacency empty = adjacency(MeshView{});
  EXPECT_EQ(empty.view().size(), 0U);
}

TEST(Adjacency, EqualsTheOracle) {
  std::size_t meshes = 0;
  std::size_t rows = 0;
  for (const Family& family : families()) {
    for (std::uint64_t seed = 0; seed < scaled(40, 2); ++seed, ++meshes) {
      const TestMesh mesh = make_mesh(family, seed, seed == 0 ? 3000 : 5 + 7 * seed);
      const Oracle oracle(mesh);
      const Adjacency graph = adjacency(mesh.view());
      ASSERT_EQ(graph.view().size(), mesh.size());
      for (std::size_t v = 0; v < mesh.size(); ++v, ++rows) {
        ASSERT_TRUE(std::ranges::equal(graph.view()[v], oracle.neighbors(v))) << mesh.name << ", vertex " << v;
      }
      EXPECT_NO_THROW(validate(GraphView{mesh.positions_view(), graph.view()})) << mesh.name;
      const double mean = mean_edge_length({mesh.positions_view(), graph.view()});
      EXPECT_NEAR(mean, oracle.mean_edge(), 1e-12 * oracle.mean_edge()) << mesh.name;
    }
  }
  std::printf("%zu meshes, %zu rows\n", meshes, rows);
}

/// Three vertices with the rows that the case gives.
void expect_graph_refused(const char* cause, const Adjacency& graph) {
  const std::vector<double> positions(9, 0.0);
  expect_refused(ErrorCode::InvalidMesh, cause, [&] { validate(GraphView{positions, graph.view()}); });
}

TEST(ValidateGraph, AcceptsASymmetricGraph) {
  const std::vector<double> positions(9, 0.0);
  const Adjacency graph{{0, 1, 3, 4}, {1, 0, 2, 1}};
  EXPECT_NO_THROW(validate(GraphView{positions, graph.view()}));
  EXPECT_NO_THROW(validate(GraphView{}));
}

TEST(ValidateGraph, NamesTheInconsistentVertex) {
  expect_graph_refused("2 rows of neighbors for 3 vertices", {{0, 1, 2}, {1, 0}});
  expect_graph_refused("0 rows of neighbors for 3 vertices", {});
  expect_graph_refused("neighbor offsets begin with 1, expected 0", {{1, 1, 2, 2}, {1, 0}});
  expect_graph_refused("neighbors of vertex 1: from 2 to 1 in a list of 4", {{0, 2, 1, 4}, {1, 2, 0, 0}});
  expect_graph_refused("neighbors of vertex 2: from 2 to 9 in a list of 2", {{0, 1, 2, 9}, {1, 0}});
  expect_graph_refused("neighbor offsets end with 2, but there are 3 neighbors", {{0, 1, 2, 2}, {1, 0, 0}});
  expect_graph_refused("neighbors of vertex 1: vertex 3, but the graph has 3 vertices", {{0, 1, 2, 2}, {1, 3}});
  expect_graph_refused("neighbors of vertex 1: the vertex itself", {{0, 0, 1, 1}, {1}});
  expect_graph_refused("neighbors of vertex 0: 1 after 2, expected ascending ids", {{0, 2, 3, 4}, {2, 1, 0, 0}});
  expect_graph_refused("neighbors of vertex 0: 1 after 1, expected ascending ids", {{0, 2, 4, 4}, {1, 1, 0, 0}});
  expect_graph_refused("neighbors of vertex 0: 1, but 0 is not among the neighbors of 1", {{0, 1, 1, 1}, {1}});
}

}  // namespace
}  // namespace meshhood::test
