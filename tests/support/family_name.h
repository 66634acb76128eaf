// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <string>

#include <gtest/gtest.h>

#include "support/families.h"

namespace meshhood::test {

/// The name of the test case of a family.
inline std::string family_name(const testing::TestParamInfo<Family>& family) {
  std::string name(family.param.name);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

/// A suite whose tests run for each family.
// NOLINTBEGIN(bugprone-macro-parentheses): the name of a class
#define MESHHOOD_SUITE_OF_FAMILIES(suite)                                   \
  class suite : public testing::TestWithParam<::meshhood::test::Family> {}; \
  INSTANTIATE_TEST_SUITE_P(All, suite, testing::ValuesIn(::meshhood::test::families()), ::meshhood::test::family_name)
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace meshhood::test
