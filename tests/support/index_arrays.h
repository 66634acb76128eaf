// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "exact/arrays.h"
#include "exact/index_access.h"

namespace meshhood::test {

/// A copy of what `index` is made of, to be damaged.
[[nodiscard]] inline IndexData arrays_of(const Index& index) {
  const IndexView& from = IndexAccess::view(index);
  const auto copy = [](auto values) {
    return std::vector<typename decltype(values)::value_type>(values.begin(), values.end());
  };
  IndexData to;
  to.frame = from.frame;
  std::visit([&](auto xyz) { to.positions = copy(xyz); }, from.positions);
  to.permutation = copy(from.permutation);
  to.slot = copy(from.slot);
  to.leaf_begin = copy(from.leaf_begin);
  to.leaves = copy(from.leaves);
  to.links = copy(from.links);
  to.cross_edges = copy(from.cross_edges);
  to.adjacency = copy(from.adjacency);
  to.groups = copy(from.groups);
  to.mean_radii = copy(from.mean_radii);
  return to;
}

}  // namespace meshhood::test
