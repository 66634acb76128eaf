// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/search.h"

namespace meshhood::inline v0_1 {

/// Appends `v`, to the last range if it follows.
inline void append_to(std::vector<VertexRange>& ranges, VertexId v) {
  if (!ranges.empty() && ranges.back().end == v) {
    ++ranges.back().end;
  } else {
    ranges.push_back({v, static_cast<VertexId>(v + 1)});
  }
}

}  // namespace meshhood::inline v0_1
