// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>

#include "exact/layout.h"

namespace meshhood {

/// The lanes of a leaf that can be reached from `from` by the edges within the leaf, `from` included. `adjacency[i]`
/// are the neighbors of lane `i`.
[[nodiscard]] inline LaneMask reachable_lanes(const LaneMask* adjacency, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

}  // namespace meshhood
