// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/search.h"

#include "exact/layout.h"

namespace meshhood {

/// Some of the vertices of a leaf.
struct LeafSubset {
  LeafId leaf;
  LaneMask lanes;
};

/// What a search finds, in index order: contiguous runs, and parts of leaves. No vertex is in two of them.
struct VertexSet {
  std::vector<VertexRange> runs;
  std::vector<LeafSubset> subsets;

  void clear() {
    runs.clear();
    subsets.clear();
  }
};

}  // namespace meshhood
