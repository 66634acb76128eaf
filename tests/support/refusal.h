// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"

namespace meshhood::test {

/// Expects `call()` to throw `Error{code}` with a message that contains `cause`. What it returns is of no interest.
template <class F>
void expect_refused(ErrorCode code, const std::string& cause, F&& call) {
  try {
    static_cast<void>(call());
    ADD_FAILURE() << "accepted; expected: " << cause;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_THAT(error.what(), testing::HasSubstr(cause));
  }
}

}  // namespace meshhood::test
