// SPDX-License-Identifier: MIT
// The exact index against the oracle: millions of answers on thousands of small meshes of all families.
#include <gtest/gtest.h>

#include "support/differential.h"
#include "support/family_name.h"
#include "support/scale.h"

namespace meshhood::test {
namespace {

class SearchDifferential : public testing::TestWithParam<Family> {};

TEST_P(SearchDifferential, AnswersAreThoseOfTheOracle) {
  compare_family(GetParam(), scaled(152, 2), 1000, [](Searcher&) {}, [](Searcher&, VertexId) {});
}

INSTANTIATE_TEST_SUITE_P(Families, SearchDifferential, testing::ValuesIn(families()), family_name);

}  // namespace
}  // namespace meshhood::test
