// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "exact/index_access.h"

namespace meshhood::test {

template <class T>
[[nodiscard]] bool same_bytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// Compares bits, so 0 differs from -0. For types without padding bytes.
template <class T>
[[nodiscard]] bool same_bits(const T& a, const T& b) {
  using Bytes = std::array<std::byte, sizeof(T)>;
  return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

[[nodiscard]] inline bool same_bytes(const PositionsInOrder& a, const PositionsInOrder& b) {
  return std::visit(
      [&](auto xyz) {
        const auto* other = std::get_if<decltype(xyz)>(&b);
        return other != nullptr && same_bytes(xyz, *other);
      },
      a);
}

/// The names of the arrays in which two indexes differ.
[[nodiscard]] inline std::vector<std::string> differences(const Index& first, const Index& second) {
  const IndexView& a = IndexAccess::view(first);
  const IndexView& b = IndexAccess::view(second);
  std::vector<std::string> result;
  if (!same_bits(a.frame, b.frame)) result.emplace_back("frame");
  const auto compare = [&](ArrayInfo info, const auto& x, const auto& y) {
    if (!same_bytes(x, y)) result.emplace_back(info.section);
  };
  for_each_array(compare, a, b);
  return result;
}

}  // namespace meshhood::test
