// SPDX-License-Identifier: MIT
// The spheres over the root groups: each root group is listed once, and each sphere holds the vertices below it.
#include "exact/root_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "support/families.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

/// Whether all vertices of a group are in the sphere.
bool holds(const IndexView& index, const FrameSphere& sphere, std::uint32_t group) {
  const GroupRecord& record = index.records[group];
  for (std::size_t v = record.begin.front(); v < record.begin.back(); ++v) {
    if (std::sqrt(squared_distance(index.in_frame(v), center_of(sphere))) > static_cast<double>(sphere.radius))
      return false;
  }
  return true;
}

class RootTrees : public testing::TestWithParam<Family> {};

TEST_P(RootTrees, HoldTheVerticesOfAllRootGroups) {
  std::size_t roots = 0;
  for (const std::size_t vertices : {1U, 40U, 300U, 2000U, 6000U}) {
    const TestMesh mesh = make_mesh(GetParam(), vertices, vertices);
    if (mesh.size() == 0) continue;
    const Index built = build(mesh.view());
    const IndexView& index = IndexAccess::view(built);
    const RootTree& tree = index.roots;
    EXPECT_EQ(tree.groups.size(),
              static_cast<std::size_t>(std::count(index.parents.begin(), index.parents.end(), kNoNode)));
    EXPECT_TRUE(std::is_sorted(tree.groups.rbegin(), tree.groups.rend()));
    ASSERT_FALSE(tree.levels.empty());
    EXPECT_EQ(tree.levels.back().size(), 1U);
    for (std::size_t i = 0; i < tree.groups.size(); ++i) {
      EXPECT_EQ(index.parents[tree.groups[i]], kNoNode);
      std::size_t place = i;
      for (const std::vector<FrameSphere>& level : tree.levels) {
        ASSERT_TRUE(holds(index, level[place], tree.groups[i])) << mesh.name << ": root group " << i;
        place /= kFanOut;
      }
    }
    roots += tree.groups.size();
  }
  std::printf("%s: %zu root groups\n", std::string(GetParam().name).c_str(), roots);
}

INSTANTIATE_TEST_SUITE_P(Families, RootTrees, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
