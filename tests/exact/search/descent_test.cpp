// SPDX-License-Identifier: MIT
// The descent against brute force: whole nodes, and leaves that intersect the surface.
#include "exact/search/descent.h"

#include <algorithm>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/search/waves.h"
#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

/// A descent from the outward search on a level.
struct Descended {
  Descended(const IndexView& index, const Kernels& kernels)
      : waves(index, kernels), states(index), descent(index, kernels) {}

  /// Gives up above `limited_above`, see `Descent::run`; never, if that is `level`.
  [[nodiscard]] bool run(const IndexView& index, const Query& query, std::size_t level, std::size_t limited_above) {
    states.start(end_of_level(index, level));
    waves.run(nodes_above(index, query.leaf())[level], query.tree_ball, states);
    return descent.run(level, waves.groups(), query, limited_above, states);
  }

  Waves waves;
  GroupStates states;
  Descent descent;
};

class DescentOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(DescentOnFamilies, WholeNodesAreInTheBallAndTheSurfaceHoldsTheRestOfWhatIsReached) {
  std::size_t inside_vertices = 0;
  const std::size_t cases = for_each_search_case(GetParam(), scaled(30, 4), 4, [&](const SearchCase& c) {
    if (!c.index.leaves[c.query.leaf()].connected) return;
    Descended d(c.index, c.kernels);
    const std::size_t levels = nodes_above(c.index, c.query.leaf()).size();
    for (std::size_t level = 0; level < levels; ++level) {
      ASSERT_TRUE(d.run(c.index, c.query, level, level));
      Ids whole;
      for (const std::uint32_t group : d.descent.groups()) {
        append_vertices(c.index, group, d.states[group].whole, whole);
      }
      ASSERT_EQ(in_ball(c, whole).size(), whole.size()) << c.mesh.name << ": a whole node is not in the ball";
      inside_vertices += whole.size();
      Ids covered = whole;
      for (const LeafId leaf : d.descent.surface_leaves()) {
        append_vertices(c.index, leaf / kFanOut, static_cast<NodeSet>(1U << leaf % kFanOut), covered);
      }
      covered = sorted(covered);
      ASSERT_EQ(std::adjacent_find(covered.begin(), covered.end()), covered.end()) << "a vertex comes twice";
      const Ids answer = c.neighborhood();
      ASSERT_TRUE(std::includes(covered.begin(), covered.end(), answer.begin(), answer.end())) << c.mesh.name;
    }
  });
  std::printf("%zu queries, %zu vertices in whole nodes\n", cases, inside_vertices);
}

INSTANTIATE_TEST_SUITE_P(Families, DescentOnFamilies, testing::ValuesIn(families()), family_name);

TEST(Descent, ManySheetsExceedTheLimitOfIntersectingNodes) {
  TestMesh mesh = make_grid(24, 24, false);
  for (int sheet = 1; sheet < 60; ++sheet) {
    TestMesh next = make_grid(24, 24, false);
    for (std::size_t i = 2; i < next.positions.size(); i += 3) next.positions[i] = 0.5 * sheet;
    const auto first = static_cast<std::uint32_t>(mesh.size());
    append(mesh, next);
    // Joined along one side, so that the search reaches all sheets.
    for (std::uint32_t i = 0; i < 24; ++i) mesh.add_face({first - 24 * 24 + i, first + i});
  }
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const Query query(index, 30 * 24 * 24 + 12 * 24 + 12, RadiusBounds(index.frame, 20));
  Descended d(index, kernels(best_isa()));
  const std::size_t top = nodes_above(index, query.leaf()).size() - 1;
  EXPECT_FALSE(d.run(index, query, top, 0));
  EXPECT_TRUE(d.run(index, query, top, top));
  const TestMesh sheet = make_grid(120, 120, false);
  const Index single = build(sheet.view());
  const IndexView& one = IndexAccess::view(single);
  const Query on_one(one, 60 * 120 + 60, RadiusBounds(one.frame, 20));
  Descended one_sheet(one, kernels(best_isa()));
  EXPECT_TRUE(one_sheet.run(one, on_one, 1, 0));
}

}  // namespace
}  // namespace meshhood::test
