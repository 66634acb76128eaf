// SPDX-License-Identifier: MIT
// Edges cut by a list: the graph is that of the mesh without them, and searches do not cross them.
#include <cstdint>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/search.h"

#include "support/families.h"
#include "support/oracle.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

TEST(CutEdges, KeepsAllOtherEdges) {
  std::size_t cut = 0;
  for (const Family& family : families()) {
    const TestMesh mesh = make_mesh(family, 3, 120);
    SCOPED_TRACE(mesh.name);
    const Oracle oracle(mesh);
    const Adjacency graph = adjacency(mesh.view());
    Random random(5);
    std::set<std::pair<VertexId, VertexId>> gone;
    std::vector<std::int64_t> edges;
    for (VertexId v = 0; v < mesh.size(); ++v) {
      for (const VertexId w : oracle.neighbors(v)) {
        if (random.below(5) != 0) continue;
        gone.insert({v, w});
        gone.insert({w, v});
        edges.insert(edges.end(), {v, w});
      }
    }
    const Adjacency result = cut_edges(graph.view(), edges);
    validate(GraphView{mesh.positions_view(), result.view()});
    for (VertexId v = 0; v < mesh.size(); ++v) {
      std::vector<VertexId> expected;
      for (const VertexId w : oracle.neighbors(v)) {
        if (!gone.contains({v, w})) expected.push_back(w);
      }
      EXPECT_THAT(result.view()[v], testing::ElementsAreArray(expected));
    }
    cut += gone.size() / 2;
  }
  std::printf("%zu edges cut\n", cut);
  EXPECT_GT(cut, 0U);
}

TEST(CutEdges, RefusesPairsThatAreNotEdgesAndNamesTheRow) {
  const TestMesh mesh = make_grid(3, 3, true);
  const Adjacency graph = adjacency(mesh.view());
  const auto cut = [&](std::vector<std::int32_t> edges) {
    return [&graph, edges = std::move(edges)] { static_cast<void>(cut_edges(graph.view(), edges)); };
  };
  expect_refused(ErrorCode::InvalidOption, "edge 1: vertices 0 and 8", cut({0, 1, 0, 8}));
  expect_refused(ErrorCode::InvalidOption, "edge 0: vertices 4 and 4", cut({4, 4}));
  expect_refused(ErrorCode::VertexOutOfRange, "edge 0: vertex -1", cut({0, -1}));
  expect_refused(ErrorCode::VertexOutOfRange, "edge 0: vertex 9", cut({9, 0}));
  expect_refused(ErrorCode::InvalidOption, "edges: 3 ends", cut({0, 1, 2}));
}

}  // namespace
}  // namespace meshhood::test
