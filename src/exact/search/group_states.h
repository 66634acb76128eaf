// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "base/epoch_array.h"
#include "exact/layout.h"

namespace meshhood::inline v0_1 {

/// What a query knows of the nodes of a group.
struct GroupState {
  NodeSet whole = 0;         // in the ball; and reached, once the outward search has ended
  NodeSet intersecting = 0;  // neither surely in the ball nor surely outside; and reached
  NodeSet reached = 0;       // by the outward search
  NodeSet pending = 0;       // linked with a reached node, and not yet reached
  NodeSet marked = 0;        // whole, with a home mark: known to be connected with the query vertex
  bool is_united = false;    // with larger whole nodes, see `OpenElements`

  /// Sets `whole` and `intersecting`. A pierced node is never whole, so it is refined to its leaves: a search uses the
  /// links of whole nodes alone, and the ends of these are no walls.
  void place(const GroupRecord& record, const GroupContainment& found) {
    const NodeSet exist = first_nodes(record.nodes);
    whole = found.inside & exist & static_cast<NodeSet>(~record.pierced);
    intersecting = (found.intersecting | (found.inside & record.pierced)) & exist;
  }
};

/// The states of all groups in one query. If no step of the search has made the state of a group, its nodes are
/// outside, not connected with the query vertex, or covered by a node of a higher level.
class GroupStates : public EpochArray<GroupState> {
 public:
  explicit GroupStates(const IndexView& index) : EpochArray(index.parents.size()), parents_(index.parents) {}

  /// Begins a new query, whose outward search is on the level that ends with the group before `end_group`.
  void start(std::size_t end_group) {
    end_group_ = end_group;
    forget();
  }

  /// The whole node that is `node` or covers it, or `kNoNode`.
  [[nodiscard]] NodeId whole_node(NodeId node) const {
    while (node != kNoNode && node / kFanOut < end_group_) {
      const std::size_t group = node / kFanOut;
      if (is_known(group)) return ((*this)[group].whole >> node % kFanOut & 1U) != 0 ? node : kNoNode;
      node = parents_[group];
    }
    return kNoNode;
  }

 private:
  std::span<const NodeId> parents_;
  std::size_t end_group_ = 0;
};

}  // namespace meshhood::inline v0_1
