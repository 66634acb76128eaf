// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace meshhood::inline v0_1 {

/// Divides the elements 0, 1, ... into disjoint sets. A set is named by its smallest element.
class DisjointSets {
 public:
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(parents_.size()); }

  void clear() { parents_.clear(); }

  /// Adds the element `size()`, in a set of its own.
  void add() { parents_.push_back(size()); }

  /// Returns the smallest element of a set, and halves the path to it (Tarjan and van Leeuwen 1984).
  [[nodiscard]] std::uint32_t first_of(std::uint32_t element) {
    while (parents_[element] != element) element = parents_[element] = parents_[parents_[element]];
    return element;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = first_of(a);
    b = first_of(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;  // by element: another of its set, or itself
};

}  // namespace meshhood::inline v0_1
