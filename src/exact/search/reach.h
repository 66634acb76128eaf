// SPDX-License-Identifier: MIT
// Finds the nodes that a ball reaches from the query vertex, outward along links in waves and down from these nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/layout.h"
#include "exact/search/query.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

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

  /// Returns the whole node that is `node` or covers it, or `kNoNode`.
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

/// The outward search: finds, on one level of the tree, the nodes that links between nodes in or across the ball
/// connect with that of the query vertex, by a breadth-first search whose steps are groups.
///
/// A component of the ball is met by nodes that are not outside and are linked with each other, so the search reaches
/// all of them or none. What it reaches is thus a union of whole components of the ball, and holds the component of the
/// query vertex.
class Waves {
 public:
  Waves(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Begins with `home`, and leaves the states of the groups it meets in `states`.
  void run(NodeId home, const TreeBall& ball, GroupStates& states);

  /// Returns the groups it has met, in the order of meeting.
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

/// Refines the nodes that intersect the surface of the ball down to the leaves.
class Descent {
 public:
  Descent(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels) {}

  /// Begins with `groups` of `level`, whose states are known. Makes the states of the groups below that it visits.
  /// Returns false as soon as more nodes intersect, on a level above `limited_above`, than a single sheet has.
  [[nodiscard]] bool run(std::size_t level, std::span<const std::uint32_t> groups, const Query& query,
                         std::size_t limited_above, GroupStates& states);

  /// Returns all groups of known state, level by level downwards from those it began with; those of a level ascend.
  [[nodiscard]] std::span<const std::uint32_t> groups() const { return groups_; }

  /// Returns the leaves that intersect the surface of the ball.
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

/// Searches outward, from the query vertex over linked, connected nodes to the surface of the ball. What it reaches is
/// a union of whole components of the ball, and holds the component of the query vertex (see `Waves`): *whole* nodes,
/// which lie in the ball, and *surface leaves*, of which only some vertices do.
class Reach {
 public:
  Reach(const IndexView& index, const Kernels& kernels)
      : index_(&index),
        kernels_(&kernels),
        states_(index),
        waves_(index, kernels),
        descent_(index, kernels),
        first_surface_leaf_(index.leaf_count() / kFanOut) {}

  /// Returns false, and reaches nothing, if leaves are what the search would begin with.
  [[nodiscard]] bool run(const Query& query);

  /// Returns the groups of known state, from the level where the search began downwards, ascending on each level.
  [[nodiscard]] std::span<const std::uint32_t> groups() const { return descent_.groups(); }

  /// Return those of the first level in the order in which the search met them, and those of the levels below.
  [[nodiscard]] std::span<const std::uint32_t> top_groups() const { return waves_.groups(); }
  [[nodiscard]] std::span<const std::uint32_t> lower_groups() const { return groups().subspan(top_groups().size()); }

  [[nodiscard]] GroupStates& states() { return states_; }
  [[nodiscard]] const GroupStates& states() const { return states_; }

  /// Returns the surface leaves, ascending, with their vertices in the ball.
  [[nodiscard]] std::span<const LeafSubset> surface_leaves() const { return surface_leaves_; }

  /// Returns the place of a leaf among the surface leaves, or `kNoPlace`.
  [[nodiscard]] std::size_t place_of(LeafId leaf) const;
  static constexpr std::size_t kNoPlace = ~std::size_t{0};

 private:
  friend struct ReachAccess;  // for tests, which begin on every level

  /// A node over the query vertex.
  struct Home {
    std::size_t level;
    NodeId node;
  };

  [[nodiscard]] Home home_of(const Query& query, double ratio) const;
  [[nodiscard]] bool reach_from(const Home& home, const Query& query, std::size_t limited_above);
  void find_surface_leaves(const Query& query);
  void settle(LeafId leaf, bool is_whole);

  const IndexView* index_;
  const Kernels* kernels_;
  GroupStates states_;
  Waves waves_;
  Descent descent_;
  std::vector<LeafSubset> surface_leaves_;
  std::vector<std::uint32_t> first_surface_leaf_;  // by group of leaves, if it has one
};

}  // namespace meshhood::inline v0_1
