// SPDX-License-Identifier: MIT
// The components of the ball that do not hold the query vertex, against brute force.
#include "exact/search/other_components.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

/// Every vertex of the ball, as if it were a local minimum.
std::vector<LocalMinimum> all_vertices(const SearchCase& c) {
  std::vector<LocalMinimum> minima;
  for (const std::uint32_t w : c.ball()) {
    if (w != c.query.vertex) minima.push_back({squared_distance_of(c, w), c.leaf_of_id(w), lane_of(c.index.slot[w])});
  }
  std::sort(minima.begin(), minima.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    return std::tie(a.square, a.leaf, a.lane) < std::tie(b.square, b.leaf, b.lane);
  });
  return minima;
}

/// States in which nothing is marked.
GroupStates unmarked(const IndexView& index) {
  GroupStates states(index);
  states.start(index.records.size());
  return states;
}

class OtherComponentsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(OtherComponentsOnFamilies, AreTheBallWithoutTheAnswer) {
  std::size_t vertices = 0;
  for_each_search_case(GetParam(), scaled(20, 3), 2, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    OtherComponents others(c.index, c.kernels);
    HomeMarks marks(c.index);
    GroupStates states = unmarked(c.index);
    ASSERT_TRUE(
        others.find(c.query, all_vertices(c), marks, states, std::numeric_limits<std::size_t>::max(), traversal));
    Ids found;
    LeafId next = 0;
    for (const LeafSubset& subset : others.found()) {
      ASSERT_GE(subset.leaf, next) << "leaves do not ascend";
      next = subset.leaf + 1;
      for_each_lane(subset.lanes, [&](unsigned lane) { found.push_back(c.id(subset.leaf, lane)); });
    }
    const Ids ball = c.ball();
    const Ids answer = c.neighborhood();
    Ids expected;
    std::set_difference(ball.begin(), ball.end(), answer.begin(), answer.end(), std::back_inserter(expected));
    ASSERT_EQ(sorted(found), expected) << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
    vertices += found.size();
  });
  std::printf("%zu vertices in other components\n", vertices);
}

INSTANTIATE_TEST_SUITE_P(Families, OtherComponentsOnFamilies, testing::ValuesIn(families()), family_name);

TEST(OtherComponents, ReturnsFalseWhenTheLimitOfVisitsIsExceeded) {
  TestMesh mesh = make_grid(60, 60, false);
  TestMesh upper = make_grid(60, 60, false);
  for (std::size_t i = 2; i < upper.positions.size(); i += 3) upper.positions[i] = 0.6;
  append(mesh, upper);
  const Oracle oracle(mesh);
  const Index built = build(mesh.view());
  const IndexView& index = IndexAccess::view(built);
  const Query query(index, 30 * 60 + 30, RadiusBounds(index.frame, 15));
  const SearchCase c{mesh, oracle, index, query, portable_kernels()};
  LeafTraversal traversal(index, portable_kernels());
  OtherComponents others(index, portable_kernels());
  const std::vector<LocalMinimum> minima = all_vertices(c);
  HomeMarks marks(index);
  GroupStates states = unmarked(index);
  EXPECT_FALSE(others.find(query, minima, marks, states, 3, traversal));
  EXPECT_TRUE(others.find(query, minima, marks, states, std::numeric_limits<std::size_t>::max(), traversal));
  EXPECT_GT(others.found().size(), 3U);
}

}  // namespace
}  // namespace meshhood::test
