// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::paper {

/// The children of each parent, ascending: parent `p` has `children[offsets[p]] .. children[offsets[p + 1] - 1]`.
struct ChildLists {
  std::vector<VertexId> offsets;
  std::vector<VertexId> children;

  [[nodiscard]] std::span<const VertexId> operator[](std::size_t parent) const {
    return std::span(children).subspan(offsets[parent],
                                       static_cast<std::size_t>(offsets[parent + 1] - offsets[parent]));
  }
};

/// parent[c]: the parent of child `c`, below `parents`.
[[nodiscard]] inline ChildLists child_lists(std::span<const VertexId> parent, std::size_t parents) {
  ChildLists result;
  result.offsets.assign(parents + 1, 0);
  for (const VertexId p : parent) ++result.offsets[p];
  std::inclusive_scan(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.children.resize(parent.size());
  for (std::size_t c = parent.size(); c-- > 0;) {
    assert(parent[c] < parents);
    result.children[--result.offsets[parent[c]]] = static_cast<VertexId>(c);
  }
  return result;
}

}  // namespace meshhood::paper
