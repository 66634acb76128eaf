// SPDX-License-Identifier: MIT
// The component of the query vertex among all that was reached, against breadth-first search.
#include "exact/search/reached_components.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/folded_sheet.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

Ids united_answer(const SearchCase& c, const SearcherAccess::State& state) {
  ReachedComponents components(c.index, c.kernels);
  VertexSet answer(c.index);
  components.find(c.query, state.descent.groups(), state.surface_leaves, state.states, answer);
  Ids ids;
  answer.for_each([&](std::size_t v) { ids.push_back(c.index.id(v)); });
  return sorted(std::move(ids));
}

class ReachedComponentsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(ReachedComponentsOnFamilies, OfTheQueryVertexAreItsNeighborhood) {
  std::size_t vertices = 0;
  const std::size_t searches = for_each_outward_search(
      GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, const SearcherAccess::State& state) {
        const Ids answer = united_answer(c, state);
        ASSERT_EQ(answer, c.neighborhood())
            << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
        vertices += answer.size();
      });
  std::printf("%zu searches, %zu vertices\n", searches, vertices);
}

INSTANTIATE_TEST_SUITE_P(Families, ReachedComponentsOnFamilies, testing::ValuesIn(families()), family_name);

TEST(ReachedComponents, AreUnitedWhereTraversalsWouldVisitMuch) {
  // The surface of the ball reaches the fold; the upper half is connected there, or not at all.
  const TestMesh mesh = make_folded_sheet(160);
  const Index index = build(mesh.view());
  Searcher searcher(index);
  const SearcherAccess::State& state = SearcherAccess::state(searcher);
  ReferenceSearcher reference(mesh.view());
  std::size_t united = 0;
  std::vector<VertexId> ids;
  for (std::uint32_t row = 60; row < 140; ++row) {
    for (const double beyond : {-1.2, 0.2, 0.8}) {
      const VertexId v = row * 160 + 80;
      const double radius = 159 - row + beyond;
      searcher.neighborhood(v, radius, ids);
      united += static_cast<std::size_t>(state.was_outward && state.was_united);
      ASSERT_EQ(ids.size(), reference.count(v, radius)) << "vertex " << v << ", radius " << radius;
    }
  }
  EXPECT_GT(united, 0U);
  std::printf("%zu of 240 queries united\n", united);
}

}  // namespace
}  // namespace meshhood::test
