// SPDX-License-Identifier: MIT
#include "exact/build/links.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "exact/build/leaves.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Edge = std::pair<VertexId, VertexId>;

struct Linked {
  explicit Linked(const TestMesh& mesh, unsigned threads = 1) : graph(adjacency(mesh.view())) {
    const Progress silent;
    TaskContext task(threads, silent, 0);
    leaves = make_leaves(mesh.positions_view(), EdgeSource(mesh.view().faces), make_frame(mesh.positions_view()), task);
    links = std::move(leaves.links);
  }

  [[nodiscard]] std::size_t leaf_count() const { return leaves.leaf_begin.size() - 1; }

  [[nodiscard]] VertexId vertex(std::size_t leaf, std::size_t lane) const {
    return leaves.permutation[leaves.leaf_begin[leaf] + lane];
  }

  Adjacency graph;
  LeafPartition leaves;
  Links links;
};

/// All edges, in both directions, as leaves and links hold them.
std::vector<Edge> edges_of(const Linked& mesh) {
  std::vector<Edge> result;
  for (std::size_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
    const std::size_t begin = mesh.leaves.leaf_begin[leaf];
    for (std::size_t i = begin; i < mesh.leaves.leaf_begin[leaf + 1]; ++i) {
      for (LaneMask left = mesh.links.adjacency[i]; left != 0; left &= left - 1) {
        result.emplace_back(mesh.vertex(leaf, i - begin),
                            mesh.vertex(leaf, static_cast<std::size_t>(std::countr_zero(left))));
      }
    }
    for (const Link& link : mesh.links.links_of(leaf)) {
      for (const CrossEdge& edge : mesh.links.cross_edges_of(link)) {
        result.emplace_back(mesh.vertex(leaf, edge.from), mesh.vertex(link.leaf, edge.to));
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Edge> edges_of(const AdjacencyView& graph) {
  std::vector<Edge> result;
  for (std::size_t v = 0; v < graph.size(); ++v) {
    for (const VertexId w : graph[v]) result.emplace_back(static_cast<VertexId>(v), w);
  }
  return result;
}

class LinksOfFamilies : public testing::TestWithParam<Family> {};

TEST_P(LinksOfFamilies, HoldEveryEdgeOfTheMeshOnceInEachDirection) {
  std::size_t edges = 0;
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const Linked mesh(make_mesh(GetParam(), 2, vertices));
    const std::vector<Edge> found = edges_of(mesh);
    ASSERT_EQ(found, edges_of(mesh.graph.view()));
    edges += found.size();
  }
  std::printf("%s: %zu edges\n", std::string(GetParam().name).c_str(), edges);
}

TEST_P(LinksOfFamilies, AscendByLeafThenByLane) {
  const Linked mesh(make_mesh(GetParam(), 3, 2000));
  const auto number = [](const CrossEdge& edge) { return edge.from * kLeafCapacity + edge.to; };
  for (std::size_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
    const std::span<const Link> links = mesh.links.links_of(leaf);
    for (std::size_t link = 0; link < links.size(); ++link) {
      ASSERT_NE(links[link].leaf, leaf);
      ASSERT_TRUE(link == 0 || links[link - 1].leaf < links[link].leaf);
      const std::span<const CrossEdge> edges = mesh.links.cross_edges_of(links[link]);
      ASSERT_FALSE(edges.empty());
      for (std::size_t i = 1; i < edges.size(); ++i) ASSERT_LT(number(edges[i - 1]), number(edges[i]));
    }
  }
}

TEST_P(LinksOfFamilies, TheBoundaryOfALinkAreTheVerticesWithANeighborThere) {
  const Linked mesh(make_mesh(GetParam(), 4, 2000));
  for (std::size_t leaf = 0; leaf < mesh.leaf_count(); ++leaf) {
    for (const Link& link : mesh.links.links_of(leaf)) {
      LaneMask expected = 0;
      for (const CrossEdge& edge : mesh.links.cross_edges_of(link)) expected |= LaneMask{1} << edge.from;
      ASSERT_EQ(link.boundary, expected);
    }
  }
}

void expect_same_links(const Links& a, const Links& b) {
  EXPECT_EQ(a.adjacency, b.adjacency);
  EXPECT_EQ(a.link_end, b.link_end);
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].leaf, b.links[i].leaf);
    EXPECT_EQ(a.links[i].boundary, b.links[i].boundary);
    EXPECT_EQ(a.links[i].first_cross_edge, b.links[i].first_cross_edge);
  }
  const auto number = [](const CrossEdge& edge) { return edge.from * kLeafCapacity + edge.to; };
  EXPECT_TRUE(std::ranges::equal(a.cross_edges, b.cross_edges, {}, number, number));
}

TEST_P(LinksOfFamilies, OfLeavesAreThoseThatTheEdgesOfTheMeshGive) {
  for (const std::size_t vertices : {1U, 50U, 3000U}) {
    const TestMesh mesh = make_mesh(GetParam(), 5, vertices);
    const Linked linked(mesh);
    TaskContext task;
    expect_same_links(make_links(EdgeSource(mesh.view().faces), linked.leaves.slot, linked.leaves.leaf_begin, task),
                      linked.links);
    expect_same_links(make_links(EdgeSource(linked.graph.view()), linked.leaves.slot, linked.leaves.leaf_begin, task),
                      linked.links);
  }
}

INSTANTIATE_TEST_SUITE_P(Links, LinksOfFamilies, testing::ValuesIn(families()), family_name);

TEST(Links, AreTheSameForAnyNumberOfThreads) {
  // So many cells that there are several buckets of them.
  const TestMesh mesh = make_grid(200, 200, false).finish(true);
  const Linked expected(mesh);
  EXPECT_EQ(edges_of(expected), edges_of(expected.graph.view()));
  for (const unsigned threads : {2U, 5U}) expect_same_links(Linked(mesh, threads).links, expected.links);
}

TEST(Links, OfAHubAreFoundOnceEach) {
  TestMesh mesh;
  Random random(3);
  for (int i = 0; i < 20000; ++i) mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
  for (VertexId v = 1; v < 20000; ++v) mesh.add_face({0, v, v});
  const Linked linked(mesh.finish(true));
  EXPECT_EQ(edges_of(linked), edges_of(linked.graph.view()));
}

TEST(IsConnected, AgreesWithTheTransitiveClosure) {
  Random random(1);
  std::size_t connected = 0;
  const std::size_t leaves = scaled(20000, 1000);
  for (std::size_t i = 0; i < leaves; ++i) {
    const auto size = static_cast<unsigned>(random.below(kLeafCapacity + 1));
    std::vector<LaneMask> adjacency(kLeafCapacity, 0);
    for (std::size_t edge = 0; size > 0 && edge < random.below(3 * size); ++edge) {
      const std::size_t a = random.below(size);
      const std::size_t b = random.below(size);
      adjacency[a] |= LaneMask{1} << b;
      adjacency[b] |= LaneMask{1} << a;
    }
    std::vector<LaneMask> closure = adjacency;
    for (unsigned through = 0; through < size; ++through) {
      for (LaneMask& row : closure) {
        if ((row >> through & 1U) != 0) row |= closure[through];
      }
    }
    const bool expected = size <= 1 || std::all_of(closure.begin(), closure.begin() + size,
                                                   [&](LaneMask row) { return row == first_lanes(size); });
    ASSERT_EQ(is_connected(adjacency.data(), size), expected) << size << " vertices";
    connected += expected ? 1 : 0;
  }
  std::printf("%zu leaves, %zu connected\n", leaves, connected);
  EXPECT_GT(connected, leaves / 100);
  EXPECT_LT(connected, leaves);
}

}  // namespace
}  // namespace meshhood::test
