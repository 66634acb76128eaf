// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "exact/layout.h"

namespace meshhood {

/// What a query knows of the nodes of a group.
struct GroupState {
  std::uint32_t query = 0;   // the state is valid for the query of this number only
  NodeSet whole = 0;         // in the ball; and reached, once the outward search has ended
  NodeSet intersecting = 0;  // neither surely in the ball nor surely outside; and reached
  NodeSet in_doubt = 0;      // may have a local minimum of the distance
  NodeSet reached = 0;       // by the outward search
  NodeSet pending = 0;       // linked with a reached node, and not yet reached
  NodeSet home = 0;          // whole, and known to be connected with the query vertex
  NodeSet explored = 0;      // by `HomeMarks`
};

/// The states of all groups in one query. If no step of the search has made the state of a group, its nodes are
/// outside, not connected with the query vertex, or covered by a node of a higher level.
class GroupStates {
 public:
  explicit GroupStates(const IndexView& index) : parents_(index.parents), states_(index.parents.size()) {}

  /// Begins a new query, whose outward search is on the level that ends with the group before `end_group`.
  void start(std::size_t end_group) {
    end_group_ = end_group;
    if (query_ == std::numeric_limits<std::uint32_t>::max()) {
      std::fill(states_.begin(), states_.end(), GroupState{});
      query_ = 0;
    }
    ++query_;
  }

  [[nodiscard]] bool is_known(std::size_t group) const { return states_[group].query == query_; }
  [[nodiscard]] GroupState& operator[](std::size_t group) { return states_[group]; }
  [[nodiscard]] const GroupState& operator[](std::size_t group) const { return states_[group]; }

  /// Makes the state of a group, with nothing known.
  GroupState& make(std::size_t group) { return states_[group] = GroupState{.query = query_}; }

  /// The whole node that is `node` or covers it, or `kNoNode`.
  [[nodiscard]] NodeId whole_node(NodeId node) const {
    while (node != kNoNode && node / kFanOut < end_group_) {
      const std::size_t group = node / kFanOut;
      if (is_known(group)) return (states_[group].whole >> node % kFanOut & 1U) != 0 ? node : kNoNode;
      node = parents_[group];
    }
    return kNoNode;
  }

  /// Whether `node`, or a node that covers it, has a home mark.
  [[nodiscard]] bool is_home(NodeId node) const {
    const NodeId whole = whole_node(node);
    return whole != kNoNode && (states_[whole / kFanOut].home >> whole % kFanOut & 1U) != 0;
  }

  /// For tests: continues as if `queries` queries had been started before.
  void set_query_number(std::uint32_t queries) { query_ = queries; }

 private:
  std::span<const NodeId> parents_;
  std::vector<GroupState> states_;
  std::size_t end_group_ = 0;
  std::uint32_t query_ = 0;
};

}  // namespace meshhood
