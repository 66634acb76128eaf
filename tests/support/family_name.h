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

}  // namespace meshhood::test
