// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "meshhood/error.h"

#include "judge.h"

namespace meshhood::fuzz {

/// Ends the program unless an error has one of `codes` and one line that names `file`.
inline void expect_clear(const Error& error, std::initializer_list<ErrorCode> codes, std::string_view file) {
  const std::string_view line = error.what();
  if (std::find(codes.begin(), codes.end(), error.code()) == codes.end()) fail("another error: " + std::string(line));
  if (line.find(file) == std::string_view::npos) fail("the error does not name the file: " + std::string(line));
  if (line.find_first_of("\n\r\x1b\x7f") != std::string_view::npos) fail("the error is not one printable line");
}

}  // namespace meshhood::fuzz
