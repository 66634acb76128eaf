// SPDX-License-Identifier: MIT
// Local minima of the distance, and the components that they lead to, against brute force.
#include "exact/search/local_minima.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact/search/other_components.h"
#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::test {
namespace {

constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

std::vector<LocalMinimum> minima_of(const SearchCase& c) {
  std::vector<LeafId> leaves(c.index.leaf_count());
  std::iota(leaves.begin(), leaves.end(), 0U);
  std::vector<LocalMinimum> minima;
  find_local_minima(c.index, c.kernels, leaves, c.query, minima);
  return minima;
}

/// The components of the ball except that of the query vertex.
std::vector<Ids> other_components_of(const SearchCase& c) {
  std::vector<bool> is_known(c.oracle.size());
  for (const std::uint32_t w : c.neighborhood()) is_known[w] = true;
  std::vector<Ids> components;
  for (const std::uint32_t w : c.ball()) {
    if (is_known[w]) continue;
    components.push_back(c.component_in_ball(w));
    for (const std::uint32_t u : components.back()) is_known[u] = true;
  }
  return components;
}

double squared_distance_of(const SearchCase& c, std::uint32_t w) {
  return squared_distance(c.index.position(c.leaf_of_id(w), lane_of(c.index.slot[w])), c.query.centre());
}

class LocalMinimaOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(LocalMinimaOnFamilies, HaveNoNearerNeighbor) {
  std::size_t found = 0;
  for_each_search_case(GetParam(), scaled(30, 4), 3, [&](const SearchCase& c) {
    double last = 0;
    for (const LocalMinimum& minimum : minima_of(c)) {
      const std::uint32_t w = c.id(minimum.leaf, minimum.lane);
      ASSERT_TRUE(c.is_in_ball(w));
      ASSERT_NE(w, c.query.vertex);
      ASSERT_EQ(minimum.square, squared_distance_of(c, w));
      ASSERT_GE(minimum.square, last) << "not ascending";
      last = minimum.square;
      for (const std::uint32_t u : c.oracle.neighbors(w)) {
        ASSERT_GE(squared_distance_of(c, u), minimum.square) << c.mesh.name << ": vertex " << w;
      }
      ++found;
    }
  });
  std::printf("%zu local minima\n", found);
}

TEST_P(LocalMinimaOnFamilies, IncludeANearestVertexOfEachOtherComponent) {
  std::size_t components = 0;
  for_each_search_case(GetParam(), scaled(20, 3), 2, [&](const SearchCase& c) {
    Ids minima;
    for (const LocalMinimum& minimum : minima_of(c)) minima.push_back(c.id(minimum.leaf, minimum.lane));
    for (const Ids& component : other_components_of(c)) {
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t w : component) least = std::min(least, squared_distance_of(c, w));
      ASSERT_TRUE(std::any_of(minima.begin(), minima.end(),
                              [&](std::uint32_t w) {
                                return squared_distance_of(c, w) == least &&
                                       std::binary_search(component.begin(), component.end(), w);
                              }))
          << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
      ++components;
    }
  });
  std::printf("%zu other components\n", components);
}

TEST_P(LocalMinimaOnFamilies, LeadToTheWholeOfEveryOtherComponent) {
  std::size_t vertices = 0;
  for_each_search_case(GetParam(), scaled(30, 4), 3, [&](const SearchCase& c) {
    LeafTraversal traversal(c.index, c.kernels);
    OtherComponents others(c.index, c.kernels);
    ASSERT_TRUE(others.find(c.query, minima_of(c), kAnyNumber, traversal));
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

INSTANTIATE_TEST_SUITE_P(Families, LocalMinimaOnFamilies, testing::ValuesIn(families()), family_name);

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
  const std::vector<LocalMinimum> minima = minima_of(c);
  EXPECT_FALSE(others.find(query, minima, 3, traversal));
  EXPECT_TRUE(others.find(query, minima, kAnyNumber, traversal));
  EXPECT_GT(others.found().size(), 3U);
}

}  // namespace
}  // namespace meshhood::test
