// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/distance.h"

namespace meshhood::parts {

/// A vertex: where it is and its id.
struct Site {
  Point position;
  std::uint64_t id = 0;
};

/// Returns whether the nearest points of two boxes pass the predicate. If not, then no points of the boxes do: each
/// coordinate of the difference of the nearest is the smallest, and rounded differences, squares and sums keep that
/// order. So the answer is never wrong by a rounding error. False if a box is empty.
[[nodiscard]] bool may_be_within(const BoundingBox& a, const BoundingBox& b, double squared_radius);

/// Cuts space into parts: a kd-tree, each leaf of which is a part. Every vertex belongs to one part, its owner.
///
/// A cut separates vertices by one coordinate, then by the others, then by id. So it halves any set of vertices, even
/// if many have the same coordinate or the same position.
class CutTree {
 public:
  /// Cuts so that each part owns the same number of the vertices in `sample`, up to one for each level.
  /// `parts` >= 1. O(#sample log #parts).
  CutTree(std::vector<Site> sample, std::size_t parts);

  [[nodiscard]] std::size_t owner(const Site& vertex) const;

  /// Extends the boxes around `vertex`.
  void add(const Site& vertex);

  /// Calls `f(part, box)` for the parts of `node`, ascending, whose box `may_be_within` the halo of `near`: all that
  /// own a vertex within the halo of a point of `near`, and perhaps others.
  template <class F>
  void for_each_near(const BoundingBox& near, double squared_halo, F&& f, std::size_t node = 0) const {
    const Node& here = nodes_[node];
    if (!may_be_within(here.box, near, squared_halo)) return;
    if (here.axis < 0) return f(here.second, here.box);
    for_each_near(near, squared_halo, f, node + 1);
    for_each_near(near, squared_halo, f, here.second);
  }

 private:
  struct Node {
    int axis = -1;             ///< of the cut; -1 for a part
    Site pivot;                ///< the first vertex of the second half
    std::uint32_t second = 0;  ///< the node of the second half, or the part; the first half is the next node
    BoundingBox box;           ///< of the added vertices
  };

  void cut(std::span<Site> sample, std::size_t first_part, std::size_t parts);
  [[nodiscard]] std::size_t next(std::size_t node, const Site& vertex) const;

  std::vector<Node> nodes_;  // preorder
};

}  // namespace meshhood::parts
