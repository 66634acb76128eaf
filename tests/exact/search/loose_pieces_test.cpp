// SPDX-License-Identifier: MIT
// Local minima of loose pieces against brute force.
#include "exact/search/loose_pieces.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class LoosePiecesOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(LoosePiecesOnFamilies, HaveMinimaWithoutANearerNeighborAscendingByDistance) {
  std::size_t found = 0;
  for_each_outward_search(GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, const SearcherAccess::State& state) {
    double last = 0;
    for (const LocalMinimum& minimum : state.loose.minima()) {
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

/// Whether the component has a vertex in what the outward search has reached.
bool is_reached(const SearchCase& c, const SearcherAccess::State& state, const Ids& component) {
  return std::any_of(component.begin(), component.end(), [&](std::uint32_t w) {
    const LeafId leaf = c.leaf_of_id(w);
    return state.states.whole_node(leaf) != kNoNode ||
           std::any_of(state.surface_leaves.begin(), state.surface_leaves.end(), [&](const LeafSubset& subset) {
             return subset.leaf == leaf && (subset.lanes >> lane_of(c.index.slot[w]) & 1U) != 0;
           });
  });
}

TEST_P(LoosePiecesOnFamilies, IncludeANearestVertexOfEachOtherComponentThatIsReached) {
  std::size_t others = 0;
  for_each_outward_search(GetParam(), scaled(20, 3), 3, [&](const SearchCase& c, const SearcherAccess::State& state) {
    const std::vector<Ids> components = components_of_ball(c);
    for (std::size_t i = 1; i < components.size(); ++i) {
      if (!is_reached(c, state, components[i])) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t w : components[i]) least = std::min(least, squared_distance_of(c, w));
      const auto minima = state.loose.minima();
      ASSERT_TRUE(std::any_of(minima.begin(), minima.end(),
                              [&](const LocalMinimum& minimum) {
                                return minimum.square == least &&
                                       std::binary_search(components[i].begin(), components[i].end(),
                                                          c.id(minimum.leaf, minimum.lane));
                              }))
          << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
      ++others;
    }
  });
  std::printf("%zu other components\n", others);
}

INSTANTIATE_TEST_SUITE_P(Families, LoosePiecesOnFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
