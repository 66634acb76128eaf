// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/search.h"

#include "index/layout.h"

namespace meshhood {

/// Some of the vertices of a leaf.
struct PartialLeaf {
  LeafId leaf;
  Lanes lanes;
};

/// What a search finds, in index order: contiguous runs, and parts of leaves. No vertex is in two of them.
struct Answer {
  std::vector<VertexRange> runs;
  std::vector<PartialLeaf> parts;

  void clear() {
    runs.clear();
    parts.clear();
  }
};

}  // namespace meshhood
