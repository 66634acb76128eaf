// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::paper {

/// Members by group, each group ascending: group `g` has `members[offsets[g]] .. members[offsets[g + 1] - 1]`.
struct Groups {
  std::vector<VertexId> offsets;
  std::vector<VertexId> members;

  [[nodiscard]] std::span<const VertexId> operator[](std::size_t g) const {
    return std::span(members).subspan(offsets[g], static_cast<std::size_t>(offsets[g + 1] - offsets[g]));
  }
};

/// group_of[m]: the group, below `groups`, that member `m` belongs to.
[[nodiscard]] inline Groups group(std::span<const VertexId> group_of, std::size_t groups) {
  Groups result;
  result.offsets.assign(groups + 1, 0);
  for (const VertexId g : group_of) ++result.offsets[g];
  std::inclusive_scan(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.members.resize(group_of.size());
  for (std::size_t m = group_of.size(); m-- > 0;) {
    result.members[--result.offsets[group_of[m]]] = static_cast<VertexId>(m);
  }
  return result;
}

}  // namespace meshhood::paper
