// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "exact/layout.h"
#include "exact/search/leaf_traversal.h"
#include "exact/search/vertex_set.h"

namespace meshhood {

/// Breadth-first search whose steps are leaves: looks at no leaf that the answer does not touch, at most at its
/// neighbours. Costs as much as the answer has leaves, wherever else the surface may lie.
class LeafBfs {
 public:
  explicit LeafBfs(const IndexView& index) : index_(&index) {}

  /// Appends the exact neighborhood of the vertex at `slot` (see IndexView).
  void run(std::uint32_t slot, const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk, VertexSet& answer);

 private:
  void append_to(const LeafTraversal& walk, VertexSet& answer) const;

  const IndexView* index_;
  std::vector<LeafId> queue_;
  std::vector<LeafId> reached_;
};

}  // namespace meshhood
