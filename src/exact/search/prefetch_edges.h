// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "base/prefetch.h"
#include "exact/search/vertex_set.h"

namespace meshhood {

/// Before the edges of `leaves[next]` are read: prefetches those of the leaves that come after it. Their records come
/// first, and what those point to once they have arrived.
inline void prefetch_edges_ahead(const IndexView& index, std::span<const LeafSubset> leaves, std::size_t next) {
  constexpr std::size_t kRecord = 8;
  constexpr std::size_t kContents = 4;
  if (next + kRecord < leaves.size()) prefetch(&index.leaves[leaves[next + kRecord].leaf]);
  if (next + kContents < leaves.size()) {
    const Leaf& leaf = index.leaves[leaves[next + kContents].leaf];
    fetch_lines(&index.adjacency[leaf.first], 2);
    fetch_lines(&index.links[leaf.first_link], 2);
  }
}

}  // namespace meshhood
