// SPDX-License-Identifier: MIT
// The component of the query vertex among what was reached, as a set of vertices in index order.
#include "exact/search/component.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class ComponentOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(ComponentOnFamilies, HasTheVerticesOfTheAnswerInIndexOrder) {
  std::size_t vertices = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(100, 4), 10, [&](const SearchCase& c, OutwardSearch& search) {
        std::vector<std::size_t> expected;
        const Ids answer = c.neighborhood();
        for (const std::uint32_t w : answer) {
          expected.push_back(std::size_t{c.index.leaf_begin[c.leaf_of_id(w)]} + lane_of(c.index.slot[w]));
        }
        std::sort(expected.begin(), expected.end());
        VertexSet found(c.index);
        search.component.mark(c.query, search.reach);
        search.component.complete(search.reach, found);
        std::vector<std::size_t> in_order;
        found.for_each([&](std::size_t v) { in_order.push_back(v); });
        ASSERT_EQ(in_order, expected) << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
        vertices += expected.size();
      });
  std::printf("%zu searches, %zu vertices\n", searches, vertices);
}

TEST_P(ComponentOnFamilies, HasRunsThatDoNotTouchAndSubsetsThatAreNotWhole) {
  for_each_outward_search(GetParam(), scaled(15, 3), 3, [&](const SearchCase& c, OutwardSearch& search) {
    VertexSet found(c.index);
    search.component.mark(c.query, search.reach);
    search.component.complete(search.reach, found);
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

INSTANTIATE_TEST_SUITE_P(Families, ComponentOnFamilies, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
