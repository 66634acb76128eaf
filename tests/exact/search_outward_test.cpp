// SPDX-License-Identifier: MIT
// The outward search alone, begun on every level: every answer is the component of all that it has reached. Compared
// with the oracle on all families.
#include <cstdio>

#include <gtest/gtest.h>

#include "support/family_name.h"
#include "support/outward_search.h"

namespace meshhood::test {
namespace {

class SearchOutward : public testing::TestWithParam<Family> {};

TEST_P(SearchOutward, FromEveryLevelGivesTheAnswersOfTheOracle) {
  const std::size_t searches =
      for_each_outward_search(GetParam(), scaled(100, 4), 10, [&](const SearchCase& c, OutwardSearch& search) {
        ASSERT_EQ(sorted(search.found(c.query, c.index)), c.neighborhood())
            << c.mesh.name << ": vertex " << c.query.vertex << ", radius " << c.query.radius;
      });
  std::printf("%zu searches\n", searches);
}

INSTANTIATE_TEST_SUITE_P(Families, SearchOutward, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
