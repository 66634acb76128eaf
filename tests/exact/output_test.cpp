// SPDX-License-Identifier: MIT
// Ids and distances of an answer, for every instruction set, in the order of VertexSet::for_each.
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/reorder.h"

#include "exact/vertex_set.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

constexpr VertexId kUntouched = 0xABCDU;

/// Runs and subsets of every kind: whole leaves, single lanes, none.
VertexSet draw_set(const IndexView& index, Random& random) {
  VertexSet set(index);
  for (LeafId leaf = 0; leaf < index.leaf_count(); ++leaf) {
    const LaneMask all = first_lanes(index.leaves[leaf].size);
    switch (random.below(4)) {
      case 0: set.add(VertexRange{index.leaf_begin[leaf], index.leaf_begin[leaf + 1]}); break;
      case 1: set.add_lanes(LeafSubset{leaf, all}); break;
      case 2: set.add_lanes(LeafSubset{leaf, (static_cast<LaneMask>(random.bits()) & all) | 1U}); break;
      default: break;
    }
  }
  return set;
}

void expect_output(const IndexView& index, const VertexSet& set, const Kernels& kernels) {
  std::vector<VertexId> expected;
  set.for_each([&](std::size_t v) { expected.push_back(index.id(v)); });
  ASSERT_EQ(set.count(), expected.size());

  std::vector<VertexId> replaced{kUntouched};
  replace_ids(set, index, kernels, replaced);
  EXPECT_EQ(replaced, expected);
  std::vector<VertexId> appended{kUntouched};
  append_ids(set, index, kernels, appended);
  EXPECT_EQ(appended.front(), kUntouched);
  EXPECT_EQ(std::vector<VertexId>(appended.begin() + 1, appended.end()), expected);

  std::vector<VertexId> ids(set.count() + kLeafCapacity + 1, kUntouched);
  write_ids(set, index, kernels, ids.data());
  EXPECT_EQ(ids.back(), kUntouched) << "written beyond the room";
  ids.resize(set.count());
  EXPECT_EQ(ids, expected);

  const Point center = index.position(0, 0);
  std::vector<double> distances(set.count() + 1, -1);
  write_distances(set, index, center, distances.data());
  EXPECT_EQ(distances.back(), -1) << "written beyond the room";
  std::size_t next = 0;
  set.for_each([&](std::size_t v) {
    const Point p = std::visit([&](auto xyz) { return point(xyz, v); }, index.positions);
    EXPECT_EQ(distances[next++], std::sqrt(squared_distance(p, center)));
  });
}

class Output : public testing::TestWithParam<Isa> {
 protected:
  const Kernels& tried = kernels(GetParam());
  Random random{21};
};

TEST_P(Output, IdsAreTheCallers) {
  for (const bool single : {false, true}) {
    TestMesh mesh = make_grid(37, 41, false);
    for (double& x : mesh.positions) x += random.uniform(-0.4, 0.4);
    mesh = renumbered(mesh.finish(single), random.permutation(mesh.size()));
    const Index index = build(mesh.view());
    const IndexView& view = IndexAccess::view(index);
    ASSERT_FALSE(view.permutation.empty());
    for (std::size_t round = 0; round < scaled(200, 20); ++round) {
      expect_output(view, draw_set(view, random), tried);
    }
  }
}

TEST_P(Output, IdsOfAReorderedMeshAreTheIndexOrder) {
  const TestMesh mesh = make_grid(37, 41, false);
  const ReorderedMesh reordered = reorder(mesh.view());
  const IndexView& view = IndexAccess::view(reordered.index);
  ASSERT_TRUE(view.permutation.empty());
  for (std::size_t round = 0; round < scaled(200, 20); ++round) expect_output(view, draw_set(view, random), tried);
}

TEST_P(Output, OfFewVerticesIsTheirIds) {
  const Index index = build(renumbered(bumpy_grid(20), random.permutation(400)).view());
  const IndexView& view = IndexAccess::view(index);
  for (std::size_t vertices = 1; vertices <= 12; ++vertices) {
    VertexSet set(view);
    set.add_lanes(LeafSubset{2, first_lanes(static_cast<unsigned>(vertices)) << 1U});
    expect_output(view, set, tried);
  }
}

TEST_P(Output, OfAnEmptySetNothingIsWritten) {
  const TestMesh mesh = make_grid(5, 5, false);
  const Index index = build(mesh.view());
  expect_output(IndexAccess::view(index), VertexSet(IndexAccess::view(index)), tried);
}

std::string case_name(const testing::TestParamInfo<Isa>& isa) { return name_of(isa.param); }

INSTANTIATE_TEST_SUITE_P(Isas, Output, testing::ValuesIn(available_isas()), case_name);

}  // namespace
}  // namespace meshhood::test
