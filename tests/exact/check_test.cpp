// SPDX-License-Identifier: MIT
// `Index::check` finds every kind of fault: each test damages an index by hand.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/forged_index.h"
#include "support/indexed.h"

namespace meshhood::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// One above the other, so that distances have several local minima.
TestMesh two_bumpy_grids(std::size_t side) {
  TestMesh mesh = bumpy_grid(side);
  TestMesh upper = mesh;
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] += 3;
  append(mesh, upper);
  return mesh;
}

/// The faults that `check` reports after `damage`.
std::vector<std::string> faults_after(const std::function<void(IndexData&)>& damage) {
  const auto [mesh, index] = indexed(two_bumpy_grids(50));
  IndexData arrays = arrays_of(index);
  damage(arrays);
  return IndexAccess::make(std::move(arrays)).check(mesh.view());
}

void expect_found(const char* fault, const std::function<void(IndexData&)>& damage) {
  const auto faults = faults_after(damage);
  ASSERT_THAT(faults, Not(IsEmpty())) << "not found: " << fault;
  EXPECT_THAT(faults.front(), HasSubstr(fault));
  EXPECT_LE(faults.size(), 16U);
}

MESHHOOD_SUITE_OF_FAMILIES(IndexCheckOfFamilies);

TEST_P(IndexCheckOfFamilies, FindsNothingInAnIndexOfTheMesh) {
  for (const std::size_t vertices : {1U, 50U, 3000U, 20000U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    EXPECT_THAT(build(mesh.view()).check(mesh.view()), IsEmpty()) << mesh.name;
  }
}

TEST(IndexCheck, FindsWrongNumbersAndPositions) {
  expect_found("does not have the slot of its position",
               [](IndexData& i) { std::swap(i.permutation[3], i.permutation[40]); });
  expect_found("does not have the slot of its position", [](IndexData& i) { i.slot[100] ^= 1; });
  expect_found("does not hold 1 to 32 vertices", [](IndexData& i) { --i.leaves[2].size; });
  expect_found("its position differs", [](IndexData& i) { std::get<RawVector<float>>(i.positions)[200] += 1; });
}

TEST(IndexCheck, FindsAWrongEdgeAndALeafWronglyMarkedAsConnected) {
  expect_found("its neighbors differ", [](IndexData& i) { i.adjacency[5] = 0; });
  expect_found("its neighbors differ", [](IndexData& i) { i.cross_edges[9].to ^= 1; });
  expect_found("the boundary of its link", [](IndexData& i) { i.links[7].boundary = 0; });
  expect_found("its mark as connected", [](IndexData& i) { i.leaves[4].connected = !i.leaves[4].connected; });
}

TEST(IndexCheck, FindsAForestThatDoesNotFollowFromTheLeaves) {
  expect_found("group 3: its vertices or links", [](IndexData& i) { i.records[3].linked[0] ^= 2; });
  expect_found("group 3: its vertices or links", [](IndexData& i) { --i.records[3].begin[1]; });
  expect_found("the links between nodes", [](IndexData& i) { i.node_links[5].mine ^= 1; });
}

TEST(IndexCheck, FindsASphereTooSmall) {
  expect_found("outside the bounding sphere", [](IndexData& i) { i.leaves[3].bounds.radius *= 0.9F; });
  for (std::size_t level = 0; level < 3; ++level) {
    expect_found("outside the bounding sphere",
                 [&](IndexData& i) { i.groups.at(i.levels.at(level)).radius[1] *= 0.9F; });
  }
}

}  // namespace
}  // namespace meshhood::test
