// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>

#include "meshhood/mesh.h"

namespace meshhood {

/// The shortest text that reads back as `value`.
[[nodiscard]] inline std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

/// Index `i` as it was given, with its sign.
[[nodiscard]] inline std::string to_text(const IndicesView& indices, std::size_t i) {
  return indices.visit([i](auto all) { return std::to_string(all[i]); });
}

}  // namespace meshhood
