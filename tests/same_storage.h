// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "meshhood/index.h"

#include "index/index_access.h"

namespace meshhood::test {

template <class T>
[[nodiscard]] bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Bit for bit, so that 0 differs from -0; for types without bytes between their fields.
template <class T>
[[nodiscard]] bool same_bits(const T& a, const T& b) {
  using Bytes = std::array<std::byte, sizeof(T)>;
  return std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b);
}

/// Field by field, for the bytes between them mean nothing.
[[nodiscard]] inline bool same_leaf(const Leaf& a, const Leaf& b) {
  return same_bits(a.bounds, b.bounds) && a.first == b.first && a.first_link == b.first_link && a.size == b.size &&
         a.connected == b.connected;
}

[[nodiscard]] inline bool same_level(const TreeLevel& a, const TreeLevel& b) {
  return same_bytes(a.groups, b.groups) && a.nodes == b.nodes && a.mean_radius == b.mean_radius;
}

/// The arrays in which two indexes differ.
[[nodiscard]] inline std::vector<std::string> differences(const Index& first, const Index& second) {
  const IndexStorage& a = IndexAccess::storage(first);
  const IndexStorage& b = IndexAccess::storage(second);
  std::vector<std::string> result;
  const auto compare = [&](const char* name, bool same) {
    if (!same) result.emplace_back(name);
  };
  compare("frame", same_bits(a.frame, b.frame));
  compare("positions", a.positions == b.positions);
  compare("permutation", a.permutation == b.permutation);
  compare("place", a.place == b.place);
  compare("leaf_begin", a.leaf_begin == b.leaf_begin);
  compare("leaves", std::equal(a.leaves.begin(), a.leaves.end(), b.leaves.begin(), b.leaves.end(), same_leaf));
  compare("links", same_bytes(a.links, b.links));
  compare("crossings", same_bytes(a.crossings, b.crossings));
  compare("adjacency", a.adjacency == b.adjacency);
  compare("tree", std::equal(a.tree.begin(), a.tree.end(), b.tree.begin(), b.tree.end(), same_level));
  return result;
}

}  // namespace meshhood::test
