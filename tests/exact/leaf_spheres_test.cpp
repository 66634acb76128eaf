// SPDX-License-Identifier: MIT
#include "exact/build/leaf_spheres.h"

#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "base/vector.h"
#include "exact/index_access.h"
#include "support/families.h"

namespace meshhood::test {
namespace {

TestMesh rough_grid(std::size_t side) {
  Random random(1);
  TestMesh mesh = make_grid(side, side, false);
  for (double& x : mesh.positions) x += random.uniform(-0.2, 0.2);
  return mesh.finish(true);
}

bool are_equal(const FrameSphere& a, const FrameSphere& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius;
}

TEST(LeafSpheres, EncloseTheVerticesOfTheirLeaves) {
  const Index built = build(rough_grid(60).view());
  const IndexView& index = IndexAccess::view(built);
  TaskContext task;
  const Spheres spheres = measure_leaves(index, task);
  ASSERT_EQ(spheres.size(), index.leaf_count());
  std::size_t vertices = 0;
  for (std::size_t leaf = 0; leaf < spheres.size(); ++leaf) {
    for (std::size_t i = index.leaf_begin[leaf]; i < index.leaf_begin[leaf + 1]; ++i, ++vertices) {
      ASSERT_LT(length(index.in_frame(i) - center_of(spheres[leaf])), static_cast<double>(spheres[leaf].radius));
    }
  }
  EXPECT_EQ(vertices, index.vertex_count());
}

TEST(LeafSpheres, OfSomeLeavesAreThoseOfAllLeaves) {
  const Index built = build(rough_grid(60).view());
  const IndexView& index = IndexAccess::view(built);
  const Progress silent;
  TaskContext task(3, silent, 0);
  const Spheres all = measure_leaves(index, task);
  std::vector<LeafId> some;
  for (LeafId leaf = 1; leaf < index.leaf_count(); leaf += 1 + leaf % 3) some.push_back(leaf);
  const Spheres spheres = measure_leaves(some, index, task);
  ASSERT_EQ(spheres.size(), some.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_TRUE(are_equal(spheres[i], all[some[i]])) << "leaf " << some[i];
    EXPECT_TRUE(are_equal(spheres[i], index.leaves[some[i]].bounds)) << "leaf " << some[i];
  }
}

}  // namespace
}  // namespace meshhood::test
