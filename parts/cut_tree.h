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

/// Whether the point of the box nearest to `p` passes the predicate. If not, then no point of the box does: each
/// coordinate of the difference to the nearest point is the smallest, and rounded differences, squares and sums keep
/// that order. So the answer is never wrong by a rounding error.
[[nodiscard]] bool may_hold_within(const BoundingBox& box, const Point& p, double squared_radius);

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

  /// Replaces `parts` by those, ascending, whose box may hold a vertex from which `p` passes the predicate: a superset
  /// of the parts that own a vertex within the halo of `p`.
  void find_near(const Point& p, double squared_halo, std::vector<std::uint32_t>& parts) const;

 private:
  struct Node {
    int axis = -1;             ///< of the cut; -1 for a part
    Site pivot;                ///< the first vertex of the second half
    std::uint32_t second = 0;  ///< the node of the second half, or the part; the first half is the next node
    BoundingBox box;           ///< of the added vertices
  };

  void cut(std::span<Site> sample, std::size_t first_part, std::size_t parts);
  [[nodiscard]] std::size_t next(std::size_t node, const Site& vertex) const;
  void collect(std::size_t node, const Point& p, double squared_halo, std::vector<std::uint32_t>& parts) const;

  std::vector<Node> nodes_;  // preorder
};

}  // namespace meshhood::parts
