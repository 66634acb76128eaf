// SPDX-License-Identifier: MIT
#include "exact/build/leaf_nodes.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "base/adjacency.h"
#include "base/vector.h"
#include "exact/index_access.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

/// A mesh with its index, and with its vertices in index order, in the frame.
struct Divided {
  explicit Divided(const TestMesh& mesh) : graph(adjacency(mesh.view())), built(build(mesh.view())) {
    for (std::size_t i = 0; i < index.vertex_count(); ++i) {
      const Point p = point(mesh.positions_view(), index.id(i));
      points.push_back(index.frame.to_frame(p));
    }
  }

  [[nodiscard]] NodeList nodes() {
    TaskContext task;
    return make_leaf_nodes(index, task);
  }

  /// The edges of a leaf as the mesh has them.
  [[nodiscard]] std::vector<LeafEdge> edges(std::size_t leaf) const {
    std::vector<LeafEdge> result;
    for (std::uint32_t i = index.leaf_begin[leaf]; i < index.leaf_begin[leaf + 1]; ++i) {
      for (const VertexId w : graph.view()[index.id(i)]) {
        const std::uint32_t slot = index.slot[w];
        result.push_back({i - index.leaf_begin[leaf], index.leaf_begin[leaf_of(slot)] + lane_of(slot)});
      }
    }
    return result;
  }

  Adjacency graph;
  Index built;
  const IndexView& index = IndexAccess::view(built);
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
  const NodeList nodes = mesh.nodes();
  std::size_t bounded = 0;
  for (std::size_t leaf = 0; leaf < nodes.regions.size(); ++leaf) {
    const std::size_t begin = mesh.index.leaf_begin[leaf];
    const std::size_t size = mesh.index.leaf_begin[leaf + 1] - begin;
    const MinimumRegion expected =
        leaf_minimum_region(mesh.points, begin, size, {}, mesh.edges(leaf), center_of(nodes.bounds[leaf]));
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
  const NodeList nodes = mesh.nodes();
  for (std::size_t leaf = 0; leaf < nodes.bounds.size(); ++leaf) {
    for (std::size_t i = mesh.index.leaf_begin[leaf]; i < mesh.index.leaf_begin[leaf + 1]; ++i) {
      EXPECT_LT(length(mesh.points[i] - center_of(nodes.bounds[leaf])), static_cast<double>(nodes.bounds[leaf].radius));
    }
  }
}

TEST(LeafNodes, HaveUnboundedRegionsIfSquaredDistancesUnderflow) {
  TestMesh tiny = rough_grid(20);
  for (double& x : tiny.positions) x *= 0x1p-500;
  Divided mesh(tiny);
  const NodeList nodes = mesh.nodes();
  for (std::size_t leaf = 0; leaf < nodes.regions.size(); ++leaf) {
    EXPECT_TRUE(mesh.index.leaves[leaf].size == 0 || !std::isfinite(nodes.regions[leaf].offset));
  }
}

}  // namespace
}  // namespace meshhood::test
