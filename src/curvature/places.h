// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"

namespace meshhood {

/// The places in index order of the vertices that lie within `radius` of the one at `place` and are connected with it.
/// They ascend.
inline void find_places(Searcher& searcher, const IndexView& index, std::uint32_t place, double radius,
                        std::vector<std::uint32_t>& found) {
  found.clear();
  for (const VertexRange& range : searcher.ranges(index.id(place), radius)) {
    for (VertexId i = range.begin; i < range.end; ++i) found.push_back(i);
  }
}

}  // namespace meshhood
