// SPDX-License-Identifier: MIT
// The component by union-find against breadth-first search: of what home marks leave open, and of all that was reached.
#include "exact/search/open_elements.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"
#include "support/sheets.h"

namespace meshhood::test {
namespace {

/// Marks, unites, and compares what is marked then with the answer. Returns how many vertices union-find has marked.
std::size_t expect_answer_marked(const SearchCase& c, OutwardSearch& search, bool all_open) {
  if (all_open) {
    HomeMarksAccess::begin(search.marks, c.query, search.reach);
  } else {
    search.marks.spread(c.query, search.reach);
  }
  const std::size_t before = search.marked(c).size();
  search.open.unite(search.reach, search.marks);
  const Ids marked = sorted(search.marked(c));
  EXPECT_EQ(marked, c.neighborhood()) << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
  return marked.size() - before;
}

class OpenElementsOnFamilies : public testing::TestWithParam<Family> {};

TEST_P(OpenElementsOnFamilies, AreMarkedIfTheyBelongToTheAnswer) {
  std::size_t marked = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, OutwardSearch& search) {
        marked += expect_answer_marked(c, search, false);
        ASSERT_FALSE(testing::Test::HasFailure());
      });
  std::printf("%zu searches, %zu vertices marked\n", searches, marked);
}

TEST_P(OpenElementsOnFamilies, FindTheAnswerWithoutTheHelpOfHomeMarks) {
  std::size_t marked = 0;
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(30, 4), 4, [&](const SearchCase& c, OutwardSearch& search) {
        marked += expect_answer_marked(c, search, true);
        ASSERT_FALSE(testing::Test::HasFailure());
      });
  std::printf("%zu searches, %zu vertices marked\n", searches, marked);
}

INSTANTIATE_TEST_SUITE_P(Families, OpenElementsOnFamilies, testing::ValuesIn(families()), family_name);

// Larger meshes, so that whole nodes of several levels lie beside each other.
TEST(OpenElements, FindTheAnswerOfPartsThatANarrowWayJoins) {
  Random random(6);
  std::size_t marked = 0;
  std::size_t searches = 0;
  for (const TestMesh& mesh : {make_hairpin(16, 3, 88), make_bridged_pads()}) {
    for (const bool all_open : {false, true}) {
      const auto draw = [&](const Oracle& oracle) {
        const auto v = static_cast<VertexId>(random.below(oracle.size()));
        return std::vector<std::pair<VertexId, double>>{{v, random.uniform(20, 80)}};
      };
      searches += for_each_level(mesh, scaled(150, 30), draw, [&](const SearchCase& c, OutwardSearch& search) {
        marked += expect_answer_marked(c, search, all_open);
        ASSERT_FALSE(testing::Test::HasFailure());
      });
    }
  }
  std::printf("%zu searches, %zu vertices marked\n", searches, marked);
  EXPECT_GT(marked, 0U);
}

TEST(OpenElements, FindTheAnswerAmongNodesOfAllSizes) {
  Random random(5);
  std::size_t marked = 0;
  std::size_t searches = 0;
  for (const bool all_open : {false, true}) {
    const TestMesh mesh = make_folded_sheet(100, 1.5);
    const auto draw = [&](const Oracle&) {
      const auto row = static_cast<VertexId>(20 + random.below(79));
      const VertexId v = row * 100 + static_cast<VertexId>(random.below(100));
      return std::vector<std::pair<VertexId, double>>{{v, 99.0 - row + random.uniform(-4, 2)},
                                                      {v, random.uniform(5, 90)}};
    };
    searches += for_each_level(mesh, scaled(60, 12), draw, [&](const SearchCase& c, OutwardSearch& search) {
      marked += expect_answer_marked(c, search, all_open);
      ASSERT_FALSE(testing::Test::HasFailure());
    });
  }
  std::printf("%zu searches, %zu vertices marked\n", searches, marked);
  EXPECT_GT(marked, 0U);
}

}  // namespace
}  // namespace meshhood::test
