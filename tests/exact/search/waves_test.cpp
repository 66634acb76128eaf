// SPDX-License-Identifier: MIT
// The outward search on each level against the components of the ball.
#include "exact/search/waves.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

/// The vertices in the ball below the nodes that the outward search reaches from `home`.
Ids reached_from(const SearchCase& c, NodeId home, std::size_t level, Waves& waves, GroupStates& states) {
  states.start(end_of_level(c.index, level));
  waves.run(home, c.query.tree_ball, states);
  Ids ids;
  for (const std::uint32_t group : waves.groups()) {
    const GroupState& state = states[group];
    EXPECT_EQ((state.whole | state.intersecting) & ~unsigned{state.reached}, 0U) << "a node that is not reached";
    append_vertices(c.index, group, states[group].whole | states[group].intersecting, ids);
  }
  return in_ball(c, std::move(ids));
}

class WavesOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(WavesOnFamilies, ReachWholeComponentsOfTheBallOnEveryLevelAndThatOfTheQueryVertex) {
  std::size_t runs = 0;
  std::size_t left_out = 0;
  for_each_search_case(GetParam(), scaled(25, 3), 3, [&](const SearchCase& c) {
    if (!c.index.leaves[c.query.leaf()].connected) return;
    Waves waves(c.index, c.kernels);
    GroupStates states(c.index);
    const std::vector<Ids> components = components_of_ball(c);
    const std::vector<NodeId> homes = nodes_above(c.index, c.query.leaf());
    for (std::size_t level = 0; level < homes.size(); ++level) {
      const Ids reached = reached_from(c, homes[level], level, waves, states);
      ASSERT_EQ(std::adjacent_find(reached.begin(), reached.end()), reached.end()) << "a vertex comes twice";
      for (const Ids& component : components) {
        const bool is_reached = std::binary_search(reached.begin(), reached.end(), component.front());
        ASSERT_TRUE(is_reached || &component != components.data()) << c.mesh.name << ": not the query vertex's own";
        for (const std::uint32_t w : component) {
          ASSERT_EQ(std::binary_search(reached.begin(), reached.end(), w), is_reached)
              << c.mesh.name << ": vertex " << w << " seen from " << c.query.vertex << ", radius " << c.query.radius;
        }
        left_out += static_cast<std::size_t>(!is_reached);
      }
      ++runs;
    }
  });
  std::printf("%zu runs, %zu components left out\n", runs, left_out);
}

INSTANTIATE_TEST_SUITE_P(Families, WavesOnFamilies, testing::ValuesIn(families()), family_name);

TEST(Waves, LeaveOutASheetThatIsNotConnectedAtTheScaleOfTheNodes) {
  TestMesh mesh = make_grid(80, 80, false);
  TestMesh upper = make_grid(80, 80, false);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] = 0.5;
  append(mesh, upper);
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const Query query(index, 40 * 80 + 40, RadiusBounds(index.frame, 25));
  const SearchCase c{mesh, oracle, index, query, kernels(best_isa())};
  Waves waves(index, kernels(best_isa()));
  GroupStates states(index);
  const std::vector<NodeId> homes = nodes_above(index, query.leaf());
  for (std::size_t level = 0; level < homes.size(); ++level) {
    EXPECT_EQ(reached_from(c, homes[level], level, waves, states), c.neighborhood()) << "level " << level;
  }
  EXPECT_LT(c.neighborhood().size(), c.ball().size());
}

}  // namespace
}  // namespace meshhood::test
