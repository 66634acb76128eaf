// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"

namespace meshhood::test {

/// Expects `call()` to throw `Error{code}` with a message that contains `culprit`.
template <class F>
void expect_refused(ErrorCode code, const std::string& culprit, F&& call) {
  try {
    call();
    ADD_FAILURE() << "accepted; expected: " << culprit;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_THAT(error.what(), testing::HasSubstr(culprit));
  }
}

}  // namespace meshhood::test
