// SPDX-License-Identifier: MIT
// Sets of vertices against std::set.
#include "exact/search/vertex_set.h"

#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "support/families.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

using Vertices = std::set<std::size_t>;  // in index order

Vertices vertices_of(const VertexSet& set) {
  Vertices result;
  set.for_each([&](std::size_t v) { EXPECT_TRUE(result.insert(v).second) << "vertex " << v << " comes twice"; });
  return result;
}

Vertices vertices_of(const IndexView& index, const LeafSubset& subset) {
  Vertices result;
  for_each_lane(subset.lanes, [&](unsigned lane) { result.insert(index.leaf_begin[subset.leaf] + lane); });
  return result;
}

class VertexSetTest : public testing::Test {
 protected:
  [[nodiscard]] LaneMask all_lanes(LeafId leaf) const { return first_lanes(index.leaves[leaf].size); }
  [[nodiscard]] LaneMask draw_lanes(LeafId leaf) {
    const auto drawn = static_cast<LaneMask>(random.bits() & random.bits());
    return random.below(4) == 0 ? all_lanes(leaf) : drawn & all_lanes(leaf);
  }

  /// Adds runs and subsets of leaves that ascend with gaps. Returns the vertices.
  Vertices fill(VertexSet& set) {
    Vertices expected;
    const auto leaves = static_cast<LeafId>(index.leaf_count());
    for (auto leaf = static_cast<LeafId>(random.below(3)); leaf < leaves;) {
      const auto end = std::min<LeafId>(leaves, leaf + 1 + static_cast<LeafId>(random.below(5)));
      if (random.below(2) == 0) {
        const VertexRange run{index.leaf_begin[leaf], index.leaf_begin[end]};
        if (run.begin < run.end) set.add(run);  // not of leaves without vertices
        for (std::size_t v = run.begin; v < run.end; ++v) expected.insert(v);
      } else if (const LeafSubset subset{leaf, draw_lanes(leaf)}; subset.lanes != 0) {
        set.add(subset);
        expected.merge(vertices_of(index, subset));
      }
      leaf = end + static_cast<LeafId>(random.below(3));
    }
    return expected;
  }

  std::vector<LeafSubset> draw_subsets() {
    std::vector<LeafSubset> subsets;
    for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
      if (random.below(3) == 0) subsets.push_back({leaf, draw_lanes(leaf)});
    }
    return subsets;
  }

  TestMesh mesh = make_grid(23, 29, false);
  Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Random random{4};
};

TEST_F(VertexSetTest, HoldsTheAddedVertices) {
  VertexSet set(index);
  for (std::size_t round = 0; round < scaled(2000, 100); ++round) {
    set.clear();
    const Vertices expected = fill(set);
    ASSERT_EQ(vertices_of(set), expected);
    ASSERT_EQ(set.count(), expected.size());
  }
}

TEST_F(VertexSetTest, SubtractRemovesTheVerticesOfTheSubsets) {
  VertexSet set(index);
  for (std::size_t round = 0; round < scaled(2000, 100); ++round) {
    set.clear();
    Vertices expected = fill(set);
    const std::vector<LeafSubset> others = draw_subsets();
    for (const LeafSubset& other : others) {
      for (const std::size_t v : vertices_of(index, other)) expected.erase(v);
    }
    set.subtract(others);
    ASSERT_EQ(vertices_of(set), expected);
    ASSERT_EQ(set.count(), expected.size());
  }
}

TEST_F(VertexSetTest, SubtractingNothingOrEverything) {
  VertexSet set(index);
  const Vertices expected = fill(set);
  set.subtract({});
  EXPECT_EQ(vertices_of(set), expected);
  std::vector<LeafSubset> all;
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) all.push_back({leaf, all_lanes(leaf)});
  set.subtract(all);
  EXPECT_EQ(set.count(), 0U);
  EXPECT_THAT(set.runs(), testing::IsEmpty());
  EXPECT_THAT(set.subsets(), testing::IsEmpty());
}

TEST_F(VertexSetTest, AllAsRunsAreTheSameVerticesInRunsThatAreNotEmpty) {
  VertexSet set(index);
  for (std::size_t round = 0; round < scaled(2000, 100); ++round) {
    set.clear();
    const Vertices expected = fill(set);
    Vertices found;
    for (const VertexRange& run : set.all_as_runs()) {
      ASSERT_LT(run.begin, run.end);
      for (std::size_t v = run.begin; v < run.end; ++v) ASSERT_TRUE(found.insert(v).second);
    }
    ASSERT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace meshhood::test
