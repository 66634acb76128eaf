// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace meshhood {

/// For every set of eight bits: where they are, first to last, a byte each. What follows the last is 0.
inline constexpr std::array<std::array<std::uint8_t, 8>, 256> kLaneLists = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lists{};
  for (unsigned set = 0; set < 256; ++set) {
    std::size_t size = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit) {
      if ((set >> bit & 1U) != 0) lists[set][size++] = bit;
    }
  }
  return lists;
}();

}  // namespace meshhood
