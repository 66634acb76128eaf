// SPDX-License-Identifier: MIT
// Sure leaves are whole in the exact answers of all vertices of their leaf, and those of a smaller radius come first.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/meshhood.h"

#include "curvature/packet_moments.h"
#include "exact/index_access.h"
#include "support/families.h"
#include "support/indexed.h"
#include "support/random.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

std::vector<LeafId> sure_leaves(SureLeaves& sure, const IndexView& index, LeafId leaf, double radius) {
  const TreeBounds bounds(index.frame, radius);
  std::vector<LeafId> leaves;
  sure.begin(leaf);
  while (const auto next = sure.next(bounds)) leaves.push_back(*next);
  return leaves;
}

/// Whether the neighborhood of each vertex of a leaf has all vertices of the other leaves.
void expect_whole(const Index& index, LeafId leaf, double radius, const std::vector<LeafId>& leaves) {
  const IndexView& view = IndexAccess::view(index);
  Searcher searcher(index);
  for (std::size_t i = 0; i < view.leaves[leaf].size; ++i) {
    std::vector<bool> has(view.vertex_count());
    for (const VertexRange& range : searcher.ranges(view.id(view.leaves[leaf].first + i), radius)) {
      for (VertexId place = range.begin; place < range.end; ++place) has[place] = true;
    }
    for (const LeafId other : leaves) {
      for (std::size_t k = 0; k < view.leaves[other].size; ++k) {
        ASSERT_TRUE(has[view.leaves[other].first + k])
            << "leaf " << other << " of leaf " << leaf << " at radius " << radius;
      }
    }
  }
}

/// Checks the leaves of an index at growing radii, and returns how many sure leaves there were.
std::size_t check(const Index& index, double edge) {
  const IndexView& view = IndexAccess::view(index);
  SureLeaves sure(view);
  std::size_t count = 0;
  for (LeafId leaf = 0; leaf < view.leaf_count(); leaf += 1 + static_cast<LeafId>(view.leaf_count() / 8)) {
    std::vector<LeafId> before;
    for (const double radius : {0.0, edge, 3 * edge, 8 * edge, 20 * edge, std::numeric_limits<double>::infinity()}) {
      const std::vector<LeafId> leaves = sure_leaves(sure, view, leaf, radius);
      EXPECT_TRUE(std::equal(before.begin(), before.end(), leaves.begin(),
                             leaves.begin() + static_cast<std::ptrdiff_t>(std::min(before.size(), leaves.size()))));
      EXPECT_EQ(std::set(leaves.begin(), leaves.end()).size(), leaves.size());
      EXPECT_TRUE(leaves.empty() || leaves.front() == leaf);
      expect_whole(index, leaf, radius, leaves);
      count += leaves.size();
      before = leaves;
    }
  }
  return count;
}

TEST(SureLeaves, AreWholeInTheAnswersOfAllVerticesOfALeaf) {
  Random random(1);
  std::size_t count = 0;
  for (const Family& family : families()) {
    for (const std::size_t vertices : {std::size_t{40}, scaled(700, 150)}) {
      const TestMesh mesh = make_mesh(family, vertices, vertices);
      if (mesh.size() == 0) continue;
      SCOPED_TRACE(family.name);
      const Index index = build(mesh.view());
      const GraphData graph = extract_graph(index);
      const double edge = mean_edge_length(graph.view());
      if (!(edge > 0 && 20 * edge < std::numeric_limits<double>::infinity())) continue;
      count += check(index, edge);
      std::vector<std::uint8_t> mask(mesh.size());
      for (std::uint8_t& value : mask) value = random.below(20) == 0 ? 1 : 0;
      check(masked(index, {.walls = mask}), edge);
      check(masked(index, {.ignored = mask}), edge);
    }
  }
  EXPECT_GT(count, scaled(1000, 100));
  std::printf("%zu sure leaves\n", count);
}

TEST(SureLeaves, OfARegularMeshAreManyInALargeBall) {
  const auto [mesh, index] = indexed(bumpy_grid(60).finish(false));
  const IndexView& view = IndexAccess::view(index);
  SureLeaves sure(view);
  EXPECT_EQ(sure_leaves(sure, view, 5, std::numeric_limits<double>::infinity()).size(), view.leaf_count());
  EXPECT_GT(sure_leaves(sure, view, 5, 25).size(), view.leaf_count() / 8);
  EXPECT_TRUE(sure_leaves(sure, view, 5, 1).empty());
}

TEST(SureLeaves, HaveTheQueriesThatWereSetSinceTheBeginning) {
  const auto [mesh, index] = indexed(bumpy_grid(20).finish(false));
  SureLeaves sure(IndexAccess::view(index));
  sure.begin(1);
  ASSERT_EQ(sure.next(TreeBounds(IndexAccess::view(index).frame, 100)), LeafId{1});
  EXPECT_EQ(sure.queries(1), 0U);
  sure.set_queries(1, 0b101);
  EXPECT_EQ(sure.queries(1), 0b101U);
  sure.begin(2);
  EXPECT_EQ(sure.queries(1), 0U);
}

}  // namespace
}  // namespace meshhood::test
