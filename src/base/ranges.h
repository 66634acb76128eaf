// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/search.h"

namespace meshhood::inline v0_1 {

/// Appends a range, or extends the last one if it follows.
inline void append_to(std::vector<VertexRange>& ranges, const VertexRange& next) {
  if (!ranges.empty() && ranges.back().end == next.begin) {
    ranges.back().end = next.end;
  } else {
    ranges.push_back(next);
  }
}
inline void append_to(std::vector<VertexRange>& ranges, VertexId v) {
  append_to(ranges, VertexRange{v, static_cast<VertexId>(v + 1)});
}

}  // namespace meshhood::inline v0_1
