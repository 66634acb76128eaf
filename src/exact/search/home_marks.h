// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "exact/layout.h"
#include "exact/search/group_states.h"

namespace meshhood {

/// Marks whole nodes that are surely connected with the query vertex, as far as a caller requests it. Whole nodes are
/// connected and in the ball, so each link between two of them is an edge of the answer. A link leads to a node of its
/// own level, or to the whole node that covers it; so a large node has no links to the small ones beside it. Marks that
/// are missed cost time in the steps that follow.
class HomeMarks {
 public:
  explicit HomeMarks(const IndexView& index) : index_(&index) {}

  /// Marks `node` if it is whole, or the whole node that covers it.
  void mark(NodeId node, GroupStates& states) const;

  /// Whether `node`, or the node that covers it, is whole and marked, or links between whole nodes lead from it to a
  /// marked one. Then all nodes on the way are marked, too. Looks at the links of each node once in a query.
  [[nodiscard]] bool leads_home(NodeId node, GroupStates& states);

  /// Whether a smaller whole node beside the whole node `whole` leads home. Then `whole` is marked. Looks for such
  /// nodes below the nodes that intersect the surface of the ball, so it takes longer than `leads_home`.
  [[nodiscard]] bool smaller_leads_home(NodeId whole, GroupStates& states);

 private:
  /// Whole nodes of a group that are connected there.
  struct Patch {
    std::uint32_t group;
    NodeSet nodes;
  };

  [[nodiscard]] bool explore(NodeId whole, GroupStates& states);
  [[nodiscard]] bool visit(NodeId whole, GroupStates& states);
  [[nodiscard]] bool visit_linked(const Patch& patch, GroupStates& states);
  [[nodiscard]] bool smaller_leads_home_below(NodeId node, const Patch& patch, GroupStates& states);
  [[nodiscard]] Patch patch_of(NodeId whole, const GroupStates& states) const;

  const IndexView* index_;
  std::vector<Patch> visited_;  // by the present exploration
};

}  // namespace meshhood
