// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"
#include "exact/search/query.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Refines the nodes that intersect the surface of the ball down to the leaves.
class Descent {
 public:
  Descent(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Begins with `groups` of `level`, whose states are known. Makes the states of the groups below that it visits.
  /// Returns false as soon as more nodes intersect, on a level above `limited_above`, than a single sheet has.
  [[nodiscard]] bool run(std::size_t level, std::span<const std::uint32_t> groups, const Query& query,
                         std::size_t limited_above, GroupStates& states);

  /// All groups of known state, level by level downwards from those it began with; those of a level ascend.
  [[nodiscard]] std::span<const std::uint32_t> groups() const { return groups_; }

  /// The leaves that intersect the surface of the ball.
  [[nodiscard]] std::span<const LeafId> surface_leaves() const { return intersecting_; }

 private:
  void append(std::uint32_t group, NodeSet intersecting);
  void add_children();
  void place(std::size_t first, const TreeBall& ball, GroupStates& states);

  const IndexView* index_;
  const Kernels* kernels_;
  std::vector<std::uint32_t> groups_;
  std::vector<GroupContainment> containments_;
  std::vector<NodeId> intersecting_;
};

}  // namespace meshhood::inline v0_1
