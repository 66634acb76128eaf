// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/parallel.h"
#include "exact/build/minimum_region.h"
#include "exact/build/tree.h"
#include "exact/layout.h"

namespace meshhood {

/// Computes the bounding sphere and the minimum region of leaves, one after the other. The region is unbounded if the
/// mesh is so small that squares of its distances underflow. O(#V + #E log(valence)) of the leaf.
///
/// index  the frame, the positions and the edges; spheres and the tree are not used
class LeafMeasure {
 public:
  explicit LeafMeasure(const IndexView& index);

  /// Sets `out.bounds[at]` and `out.regions[at]`.
  void measure(LeafId leaf, NodeList& out, std::size_t at);

 private:
  void gather_own_edges(std::size_t begin, std::size_t size);
  void gather_edges_out(LeafId leaf);

  const IndexView& index_;
  bool with_regions_;
  std::vector<Point> points_;  // the vertices of the leaf, then the other ends of its edges to other leaves
  std::vector<LeafEdge> own_edges_;
  std::vector<LeafEdge> edges_;  // to other leaves
};

/// The lowest level of the tree: all leaves.
[[nodiscard]] NodeList make_leaf_nodes(const IndexView& index, TaskContext& task);

}  // namespace meshhood
