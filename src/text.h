// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>

namespace meshhood {

/// The shortest text that reads back as `value`.
[[nodiscard]] inline std::string to_text(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

}  // namespace meshhood
