// SPDX-License-Identifier: MIT
// What the outward search reaches, from every level, against the components of the ball.
#include "exact/search/reach.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class ReachOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(ReachOnFamilies, IsAUnionOfComponentsOfTheBallWithThatOfTheQueryVertex) {
  std::size_t left_out = 0;
  std::size_t whole = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(25, 3), 3, [&](const SearchCase& c, const OutwardSearch& search) {
        const Reach& reach = search.reach;
        Ids ids;
        for (const std::uint32_t group : reach.groups()) {
          append_vertices(c.index, group, reach.states()[group].whole, ids);
        }
        whole += ids.size();
        for (const LeafSubset& leaf : reach.surface_leaves()) append_vertices(c, leaf.leaf, leaf.lanes, ids);
        ids = sorted(ids);
        ASSERT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end()) << "a vertex comes twice";
        ASSERT_EQ(in_ball(c, ids).size(), ids.size()) << c.mesh.name << ": a vertex is outside";
        const std::vector<Ids> components = components_of_ball(c);
        for (const Ids& component : components) {
          const bool is_reached = std::binary_search(ids.begin(), ids.end(), component.front());
          ASSERT_TRUE(is_reached || &component != components.data()) << c.mesh.name << ": not the query vertex's own";
          for (const std::uint32_t w : component) {
            ASSERT_EQ(std::binary_search(ids.begin(), ids.end(), w), is_reached)
                << c.mesh.name << ": vertex " << w << " seen from " << c.query.vertex << ", radius " << c.query.radius;
          }
          left_out += static_cast<std::size_t>(!is_reached);
        }
      });
  std::printf("%zu searches, %zu vertices of whole nodes, %zu components left out\n", searches, whole, left_out);
}

TEST_P(ReachOnFamilies, ListsSurfaceLeavesAscendingAndFindsTheirPlaces) {
  std::size_t listed = 0;
  for_each_outward_search(GetParam(), scaled(25, 3), 3, [&](const SearchCase& c, const OutwardSearch& search) {
    const std::span<const LeafSubset> leaves = search.reach.surface_leaves();
    std::size_t next = 0;
    for (LeafId leaf = 0; leaf < c.index.leaf_count(); ++leaf) {
      if (next == leaves.size() || leaves[next].leaf != leaf) {
        ASSERT_EQ(search.reach.place_of(leaf), Reach::kNoPlace) << c.mesh.name << ": leaf " << leaf;
        continue;
      }
      ASSERT_EQ(search.reach.place_of(leaf), next) << c.mesh.name << ": leaf " << leaf;
      LaneMask inside = 0;
      for (unsigned lane = 0; lane < c.index.leaves[leaf].size; ++lane) {
        inside |= static_cast<LaneMask>(c.is_in_ball(c.id(leaf, lane))) << lane;
      }
      ASSERT_EQ(leaves[next].lanes, inside);
      ASSERT_TRUE(inside != 0 && inside != first_lanes(c.index.leaves[leaf].size)) << "it does not meet the surface";
      ++next;
    }
    ASSERT_EQ(next, leaves.size()) << "not ascending";
    listed += next;
  });
  std::printf("%zu surface leaves\n", listed);
}

TEST_P(ReachOnFamilies, ListsGroupsByLevelAscending) {
  for_each_outward_search(GetParam(), scaled(10, 2), 2, [&](const SearchCase& c, const OutwardSearch& search) {
    const std::span<const std::uint32_t> groups = search.reach.groups();
    const std::size_t top = search.reach.top_groups().size();
    ASSERT_EQ(search.reach.lower_groups().size(), groups.size() - top);
    ASSERT_TRUE(std::is_permutation(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(top),
                                    search.reach.top_groups().begin(), search.reach.top_groups().end()));
    const auto level_of = [&](std::uint32_t group) {
      std::size_t level = 0;
      while (group >= end_of_level(c.index, level)) ++level;
      return level;
    };
    for (std::size_t i = 1; i < groups.size(); ++i) {
      const std::size_t before = level_of(groups[i - 1]);
      const std::size_t here = level_of(groups[i]);
      ASSERT_TRUE(here == before ? groups[i - 1] < groups[i] : here + 1 == before) << c.mesh.name;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, ReachOnFamilies, testing::ValuesIn(families()), family_name);

/// Many sheets, one above the other, joined along one side.
TestMesh stacked_sheets(std::size_t sheets, std::size_t side, double gap) {
  TestMesh mesh = make_grid(side, side, false);
  for (std::size_t sheet = 1; sheet < sheets; ++sheet) {
    TestMesh next = make_grid(side, side, false);
    for (std::size_t i = 2; i < next.positions.size(); i += 3) next.positions[i] = gap * static_cast<double>(sheet);
    const auto first = static_cast<std::uint32_t>(mesh.size());
    append(mesh, next);
    for (std::uint32_t i = 0; i < side; ++i)
      mesh.add_face({first - static_cast<std::uint32_t>(side * side) + i, first + i});
  }
  return mesh.finish(true);
}

/// The level on which the last run has begun, of the second start if there were two.
std::size_t first_level(const Reach& reach, const IndexView& index) {
  std::size_t level = 0;
  while (reach.top_groups()[0] >= end_of_level(index, level)) ++level;
  return level;
}

/// The level where nodes have a mean radius of a `ratio`-th of the radius or more.
std::size_t level_of_ratio(const IndexView& index, const Query& query, double ratio) {
  std::size_t level = 0;
  while (index.tree[level].mean_radius * ratio < query.radius_in_frame) ++level;
  return level;
}

TEST(Reach, BeginsWithLargeNodesOnASingleSheetAndWithSmallOnesAmongMany) {
  for (const bool is_folded : {false, true}) {
    const TestMesh mesh = is_folded ? stacked_sheets(40, 80, 0.5) : make_grid(190, 190, false);
    const VertexId v = is_folded ? 20 * 80 * 80 + 40 * 80 + 40 : 95 * 190 + 95;
    const Index built = build(mesh.view());
    const IndexView& index = IndexAccess::view(built);
    const Query query(index, v, RadiusBounds(index.frame, is_folded ? 40 : 60));
    Reach reach(index, kernels(best_isa()));
    ASSERT_TRUE(reach.run(query));
    const std::size_t small = level_of_ratio(index, query, 10);
    const std::size_t large = level_of_ratio(index, query, 2.5);
    ASSERT_LT(small, large);
    ASSERT_GT(small, 0U);
    EXPECT_EQ(first_level(reach, index), is_folded ? small : large);
  }
}

TEST(Reach, DoesNotBeginWithLeaves) {
  const TestMesh mesh = make_grid(60, 60, false);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const double leaf = index.tree[0].mean_radius / index.frame.scale;
  Reach reach(index, kernels(best_isa()));
  EXPECT_FALSE(reach.run(Query(index, 30 * 60 + 30, RadiusBounds(index.frame, 2.4 * leaf))));
  EXPECT_TRUE(reach.run(Query(index, 30 * 60 + 30, RadiusBounds(index.frame, 2.6 * leaf))));
}

TEST(Reach, DoesNotBeginAgainWithLeaves) {
  const TestMesh mesh = stacked_sheets(60, 24, 0.5);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const Query query(index, 30 * 24 * 24 + 12 * 24 + 12, RadiusBounds(index.frame, 20));
  ASSERT_EQ(level_of_ratio(index, query, 10), 0U);
  ASSERT_GT(level_of_ratio(index, query, 2.5), 0U);
  Reach reach(index, kernels(best_isa()));
  EXPECT_FALSE(reach.run(query));
}

}  // namespace
}  // namespace meshhood::test
