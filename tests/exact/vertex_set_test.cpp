// SPDX-License-Identifier: MIT
// Sets of vertices against std::set.
#include "exact/vertex_set.h"

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
        set.add_lanes(subset);
        expected.merge(vertices_of(index, subset));
      }
      leaf = end + static_cast<LeafId>(random.below(3));
    }
    return expected;
  }

  TestMesh mesh = make_grid(23, 29, false);
  Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  Random random{4};
};

TEST_F(VertexSetTest, AddsUnderAConditionOnly) {
  VertexSet set(index);
  set.make_room(4);
  set.add_if(true, {0, 10}, 0);
  set.add_if(false, {10, 20}, 0);
  set.add_if(true, {20, 30}, 3);
  set.add_if(false, {30, 40}, 1);
  EXPECT_EQ(set.count(), 12U);
  set.add_if(true, {30, 40}, 0);
  EXPECT_EQ(set.parts().size(), 3U) << "a run does not become a part of a subset";
}

TEST_F(VertexSetTest, DifferenceHasTheVerticesThatThePartDoesNotHave) {
  VertexSet all(index);
  VertexSet part(index);
  VertexSet rest(index);
  for (std::size_t round = 0; round < scaled(4000, 200); ++round) {
    all.clear();
    Vertices expected = fill(all);
    // Leaf by leaf, so that runs are cut within and at their ends.
    std::vector<LeafSubset> subsets;
    const std::size_t rarity = 1 + random.below(4);
    for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
      LaneMask lanes = random.below(rarity) == 0 ? draw_lanes(leaf) : 0;
      for_each_lane(lanes, [&](unsigned lane) {
        if (expected.erase(index.leaf_begin[leaf] + lane) == 0) lanes &= ~(LaneMask{1} << lane);
      });
      if (lanes != 0) subsets.push_back({leaf, lanes});
    }
    part.assign(subsets);
    rest.assign_difference(all, part);
    std::vector<std::size_t> listed;
    rest.for_each([&](std::size_t v) { listed.push_back(v); });
    ASSERT_THAT(listed, testing::ElementsAreArray(expected));
    ASSERT_EQ(rest.count(), expected.size());
  }
  rest.assign_difference(all, all);
  EXPECT_EQ(rest.count(), 0U);
  EXPECT_THAT(rest.parts(), testing::IsEmpty());
}

}  // namespace
}  // namespace meshhood::test
