// SPDX-License-Identifier: MIT
#include "exact/build/leaf_nodes.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "base/vector.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

/// A mesh divided into leaves, with its vertices in index order.
struct Divided {
  explicit Divided(const TestMesh& mesh) : graph(adjacency(mesh.view())) {
    const Frame frame = make_frame(mesh.positions_view());
    leaves = make_leaves({mesh.positions_view(), graph.view()}, frame, task);
    links = make_links(graph.view(), leaves, task);
    for (const VertexId v : leaves.permutation) {
      points.push_back(frame.to_frame(mesh.positions_view().visit([&](auto xyz) { return point(xyz, v); })));
    }
  }

  [[nodiscard]] NodeList nodes(bool with_regions) {
    return make_leaf_nodes(leaves.leaf_begin, links, points, with_regions, task);
  }

  /// The edges of a leaf as the mesh has them.
  [[nodiscard]] std::vector<LeafEdge> edges(std::size_t leaf) const {
    std::vector<LeafEdge> result;
    for (std::uint32_t i = leaves.leaf_begin[leaf]; i < leaves.leaf_begin[leaf + 1]; ++i) {
      for (const VertexId w : graph.view()[leaves.permutation[i]]) {
        const std::uint32_t slot = leaves.slot[w];
        result.push_back({i - leaves.leaf_begin[leaf], leaves.leaf_begin[leaf_of(slot)] + lane_of(slot)});
      }
    }
    return result;
  }

  const Progress silent;
  TaskContext task{1, silent, 0};
  Adjacency graph;
  LeafPartition leaves;
  Links links;
  std::vector<Point> points;
};

TestMesh rough_grid(std::size_t side) {
  Random random(1);
  TestMesh mesh = make_grid(side, side, false);
  for (double& x : mesh.positions) x += random.uniform(-0.2, 0.2);
  return mesh.finish(false);
}

TEST(LeafNodes, HaveTheRegionOfAllEdgesOfTheirVertices) {
  Divided mesh(rough_grid(60));
  const NodeList nodes = mesh.nodes(true);
  std::size_t bounded = 0;
  for (std::size_t leaf = 0; leaf < nodes.regions.size(); ++leaf) {
    const std::size_t begin = mesh.leaves.leaf_begin[leaf];
    const std::size_t size = mesh.leaves.leaf_begin[leaf + 1] - begin;
    const MinimumRegion expected =
        leaf_minimum_region(mesh.points, begin, size, mesh.edges(leaf), centre_of(nodes.bounds[leaf]));
    const MinimumRegion& region = nodes.regions[leaf];
    ASSERT_EQ(std::isfinite(region.offset), std::isfinite(expected.offset)) << "leaf " << leaf;
    if (!std::isfinite(expected.offset)) continue;
    ++bounded;
    EXPECT_NEAR(region.offset, expected.offset, 1e-9);
    EXPECT_NEAR(length(region.slope_axis - expected.slope_axis), 0, 1e-9);
  }
  std::printf("%zu leaves, %zu with a bounded region\n", nodes.regions.size(), bounded);
  EXPECT_GT(bounded, nodes.regions.size() / 3) << "those away from the rim of the grid";
}

TEST(LeafNodes, HaveSpheresAroundTheirVertices) {
  Divided mesh(rough_grid(60));
  const NodeList nodes = mesh.nodes(true);
  for (std::size_t leaf = 0; leaf < nodes.bounds.size(); ++leaf) {
    for (std::size_t i = mesh.leaves.leaf_begin[leaf]; i < mesh.leaves.leaf_begin[leaf + 1]; ++i) {
      EXPECT_LT(length(mesh.points[i] - centre_of(nodes.bounds[leaf])), static_cast<double>(nodes.bounds[leaf].radius));
    }
  }
}

TEST(LeafNodes, HaveUnboundedRegionsIfNoneAreWanted) {
  Divided mesh(rough_grid(20));
  for (const MinimumRegion& region : mesh.nodes(false).regions) EXPECT_FALSE(std::isfinite(region.offset));
}

}  // namespace
}  // namespace meshhood::test
