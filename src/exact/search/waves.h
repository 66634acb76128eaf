// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// The outward search: finds, on one level of the tree, the nodes that links between nodes in or across the ball
/// connect with the query vertex's own. A breadth-first search whose steps are groups.
///
/// A component of the ball is met by nodes that are not outside and are linked with each other, so the search reaches
/// all of them or none. What it reaches is thus a union of whole components of the ball, and holds the component of the
/// query vertex.
class Waves {
 public:
  Waves(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Begins with `home`, and leaves the states of the groups it meets in `states`.
  void run(NodeId home, const TreeBall& ball, GroupStates& states);

  /// The groups it has met, in the order of meeting.
  [[nodiscard]] std::span<const std::uint32_t> groups() const { return groups_; }

 private:
  void meet(NodeId node, GroupStates& states);
  void place(std::size_t first_new, const TreeBall& ball, GroupStates& states);
  void spread(std::uint32_t group, GroupStates& states);

  const IndexView* index_;
  const Kernels* kernels_;
  std::vector<std::uint32_t> groups_;
  std::vector<std::uint32_t> wave_;
  std::vector<std::uint32_t> next_wave_;
  std::vector<GroupContainment> containments_;
};

}  // namespace meshhood::inline v0_1
