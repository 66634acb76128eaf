// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "simd/leaf.h"
#include "simd/query_word.h"

namespace meshhood {

/// Bit `i` for each lane `i`.
template <class T>
inline constexpr PerLane<T> kLaneBits = [] {
  PerLane<T> bits{};
  for (std::size_t i = 0; i < kLeafCapacity; ++i) bits[i] = static_cast<T>(T{1} << i);
  return bits;
}();

/// For every set of four words of 32 bits: the places of their bytes.
alignas(16) inline constexpr std::array<std::array<std::uint8_t, 16>, 16> kBytePlaces = [] {
  std::array<std::array<std::uint8_t, 16>, 16> lists{};
  for (std::size_t set = 0; set < 16; ++set) {
    for (std::size_t i = 0; i < 16; ++i)
      lists[set][i] = static_cast<std::uint8_t>(4 * kBitPositions[set][i / 4] + i % 4);
  }
  return lists;
}();

}  // namespace meshhood
