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

/// Bit for bit, so that 0 differs from -0; for types without bytes between their fields.
template <class T>
[[nodiscard]] bool same_bits(const T& a, const T& b) {
  using Bytes = std::array<std::byte, sizeof(T)>;
  return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

/// The arrays in which two indexes differ.
[[nodiscard]] inline std::vector<std::string> differences(const Index& first, const Index& second) {
  const IndexView& a = IndexAccess::view(first);
  const IndexView& b = IndexAccess::view(second);
  std::vector<std::string> result;
  const auto compare = [&](const char* name, bool same) {
    if (!same) result.emplace_back(name);
  };
  compare("frame", same_bits(a.frame, b.frame));
  compare("positions", std::visit(
                           [&](auto xyz) {
                             const auto* other = std::get_if<decltype(xyz)>(&b.positions);
                             return other != nullptr && same_bytes(xyz, *other);
                           },
                           a.positions));
  compare("permutation", same_bytes(a.permutation, b.permutation));
  compare("place", same_bytes(a.slot, b.slot));
  compare("leaf_begin", same_bytes(a.leaf_begin, b.leaf_begin));
  compare("leaves", same_bytes(a.leaves, b.leaves));
  compare("links", same_bytes(a.links, b.links));
  compare("crossings", same_bytes(a.cross_edges, b.cross_edges));
  compare("adjacency", same_bytes(a.adjacency, b.adjacency));
  compare("groups", same_bytes(a.groups, b.groups));
  compare("mean_radii", same_bytes(a.mean_radii, b.mean_radii));
  return result;
}

}  // namespace meshhood::test
