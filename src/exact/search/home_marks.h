// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"

namespace meshhood {

/// Marks whole nodes that are surely connected with the query vertex: from its own node on, along links between whole
/// nodes, which are connected and in the ball, so that each link is an edge of the answer. A link leads to a node of
/// its own level, or to the whole node that covers it. Finds nearly all of them; what it misses costs time in the steps
/// that follow.
class HomeMarks {
 public:
  explicit HomeMarks(const IndexView& index) : index_(&index) {}

  /// Marks `node` if it is whole, or the whole node that covers it. Returns whether it was not marked before.
  bool mark(NodeId node, GroupStates& states) const;

  /// Does so for the leaf of the query vertex, and marks what is next to it: on a smooth surface nearly all that is in
  /// doubt.
  void begin(NodeId leaf, GroupStates& states);

  /// Marks what the marked nodes lead to, in `groups`, which are in the order of the descent, if enough is in doubt to
  /// be worth it.
  void spread(std::span<const std::uint32_t> groups, GroupStates& states);

 private:
  static constexpr std::size_t kGroupsAhead = 6;

  [[nodiscard]] std::size_t count_doubts(std::span<const std::uint32_t> groups, const GroupStates& states) const;
  [[nodiscard]] bool pull(std::uint32_t group, GroupStates& states) const;
  void pull_unmarked(GroupStates& states);
  void push(std::uint32_t group, GroupStates& states);
  void prefetch_links(std::uint32_t group, const GroupStates& states) const;

  const IndexView* index_;
  std::vector<std::uint32_t> gained_;    // groups with new marks, which spread from there
  std::vector<std::uint32_t> unmarked_;  // groups with a whole node in doubt that is not marked
};

}  // namespace meshhood
