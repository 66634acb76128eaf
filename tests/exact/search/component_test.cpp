// SPDX-License-Identifier: MIT
// The component of the query vertex among what was reached, from every level, as a set of vertices in index order.
#include "exact/search/component.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/search_case.h"

namespace meshhood::inline v0_1 {

struct ReachAccess {
  /// As `Reach::run` does, but begins with a node over the query vertex on any level.
  static void run(Reach& reach, const Query& query, const Reach::Home& home) {
    static_cast<void>(reach.reach_from(home, query, home.level));
    reach.find_surface_leaves(query);
  }

  /// The node over the query vertex on each level, as far as there is one.
  static std::vector<Reach::Home> homes(const IndexView& index, const Query& query) {
    std::vector<Reach::Home> all;
    for (NodeId node = query.leaf(); node != kNoNode; node = index.parents[node / kFanOut]) {
      all.push_back({all.size(), node});
    }
    return all;
  }
};

}  // namespace meshhood::inline v0_1

namespace meshhood::test {
namespace {

/// Calls `f(case, found)` for queries on small meshes of a family, searched from each level in turn. Returns the number
/// of calls.
template <class F>
std::size_t for_each_outward_search(const Family& family, std::size_t meshes, std::size_t vertices_per_mesh, F&& f) {
  std::size_t searches = 0;
  for_each_search_case(family, meshes, vertices_per_mesh, [&](const SearchCase& c) {
    // The leaf of the query vertex would be no node of the search.
    if (!c.index.leaves[c.query.leaf()].connected || testing::Test::HasFatalFailure()) return;
    Reach reach(c.index, c.kernels);
    Component component(c.index, c.kernels);
    for (const auto& home : ReachAccess::homes(c.index, c.query)) {
      ReachAccess::run(reach, c.query, home);
      VertexSet found(c.index);
      component.mark(c.query, reach);
      component.complete(reach, found);
      f(c, found);
      ++searches;
    }
  });
  return searches;
}

MESHHOOD_SUITE_OF_FAMILIES(ComponentOnFamilies);

TEST_P(ComponentOnFamilies, HasTheVerticesOfTheAnswerInIndexOrder) {
  std::size_t vertices = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(100, 4), 10, [&](const SearchCase& c, const VertexSet& found) {
        std::vector<std::size_t> expected;
        for (const std::uint32_t w : c.neighborhood()) {
          expected.push_back(std::size_t{c.index.leaf_begin[c.leaf_of_id(w)]} + lane_of(c.index.slot[w]));
        }
        std::sort(expected.begin(), expected.end());
        std::vector<std::size_t> in_order;
        found.for_each([&](std::size_t v) { in_order.push_back(v); });
        ASSERT_EQ(in_order, expected) << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
        vertices += expected.size();
      });
  std::printf("%zu searches, %zu vertices\n", searches, vertices);
}

TEST_P(ComponentOnFamilies, HasRunsThatDoNotTouchAndSubsetsThatAreNotWhole) {
  for_each_outward_search(GetParam(), scaled(15, 3), 3, [&](const SearchCase&, const VertexSet& found) {
    const VertexSet::Part* before = nullptr;
    for (const VertexSet::Part& part : found.parts()) {
      ASSERT_LT(part.begin, part.end);
      if (before != nullptr) {
        ASSERT_LE(before->end, part.begin);
        ASSERT_FALSE(before->is_run() && part.is_run() && before->end == part.begin) << "two runs that touch";
      }
      ASSERT_NE(part.lanes, first_lanes(std::min(part.end - part.begin, VertexId{kLeafCapacity})));
      before = &part;
    }
  });
}

}  // namespace
}  // namespace meshhood::test
