// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "exact/layout.h"
#include "exact/node_search.h"
#include "exact/query/any_center.h"

namespace meshhood::inline v0_1 {

/// Returns a reach from a center that covers everything within `distance` of a point, if `distance` already includes
/// that from the point to the center: the three distances are each rounded a few times by 2^-53 of their size, or of
/// 2^-537 where squares underflow.
[[nodiscard]] inline double reach_of(double distance) { return distance * (1 + 1e-14) + 0x1p-500; }

/// Visits the leaves of an index around a center, connected or not: depth first through the tree, the nearest node of a
/// group first. A node is skipped if it is farther away than the visitor still reaches. A visitor has
///
///     double reach() const;           // what is farther from the center does not matter; never grows
///     bool wants(NodeId node) const;  // whether anything below the node matters
///     void visit_leaf(LeafId leaf);
template <class Visitor>
class NearestFirst {
 public:
  NearestFirst(const IndexView& index, const Center& center, Visitor& visitor)
      : index_(&index), center_(&center), visitor_(&visitor) {}

  void run() {
    if (!index_->roots.levels.empty()) visit_roots(index_->roots.levels.size() - 1, 0);
  }

 private:
  struct Child {
    double low;  // of the distances of its vertices
    std::size_t place;
  };

  /// Visits up to eight spheres of a level over the root groups, from `first` on.
  void visit_roots(std::size_t level, std::size_t first) {
    const RootTree& roots = index_->roots;
    const std::span<const FrameSphere> spheres = std::span(roots.levels[level]).subspan(first);
    const auto sphere_at = [&](std::size_t i) { return spheres[i]; };
    visit_in_order(spheres.size(), sphere_at, [&](std::size_t i) {
      if (level == 0) {
        visit_group(roots.groups[first + i]);
      } else {
        visit_roots(level - 1, (first + i) * kFanOut);
      }
    });
  }

  void visit_group(std::size_t group) {
    const GroupRecord& record = index_->records[group];
    const auto sphere_at = [&](std::size_t i) { return sphere_of(index_->groups[group], i); };
    visit_in_order(record.nodes, sphere_at, [&](std::size_t i) {
      const auto node = static_cast<NodeId>(group * kFanOut + i);
      if (!visitor_->wants(node)) return;
      if (node < index_->leaf_count()) {
        visitor_->visit_leaf(node);
      } else {
        visit_group(record.first_child + i);
      }
    });
  }

  /// Calls `visit(i)` for up to eight of `count` spheres, the nearest first, as long as the visitor reaches them.
  template <class SphereAt, class Visit>
  void visit_in_order(std::size_t count, SphereAt&& sphere_at, Visit&& visit) {
    std::array<Child, kFanOut> children{};  // the first `size` ascend
    std::size_t size = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, kFanOut); ++i) {
      const double low = std::sqrt(squared_distances(sphere_at(i), *center_).low);
      if (low > visitor_->reach()) continue;
      std::size_t at = size++;
      for (; at > 0 && children[at - 1].low > low; --at) children[at] = children[at - 1];
      children[at] = {low, i};
    }
    for (const Child& child : std::span(children).first(size)) {
      if (child.low > visitor_->reach()) return;
      visit(child.place);
    }
  }

  const IndexView* index_;
  const Center* center_;
  Visitor* visitor_;
};

}  // namespace meshhood::inline v0_1
