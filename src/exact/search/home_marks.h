// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/node_search.h"
#include "exact/search/query.h"
#include "exact/search/reach.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// A set of leaves as bits, a byte for each group of leaves, to which whole nodes are added. So one look-up tells
/// whether a link leads to one of them, however large the node is that it leads to.
class LeafBits {
 public:
  explicit LeafBits(const IndexView& index) : index_(&index), groups_(index.leaf_count() / kFanOut) {}

  void clear() {
    for (const LeafGroupRange& range : added_) fill(range, 0);
    added_.clear();
  }

  /// Adds the leaves below some nodes of a group.
  void add(std::uint32_t group, NodeSet nodes) {
    if (index_->is_of_leaves(group)) {
      added_.push_back({group, group + 1});
      groups_[group] |= nodes;
    } else {
      for_each_node(nodes, [&](unsigned i) {
        added_.push_back(index_->leaf_groups_of(group * kFanOut + i));
        fill(added_.back(), first_nodes(kFanOut));
      });
    }
  }

  /// Returns 1 if it has the leaf, else 0: for masks without branches, which could not be predicted.
  [[nodiscard]] unsigned has(LeafId leaf) const { return groups_[leaf / kFanOut] >> leaf % kFanOut & 1U; }

  /// Does the same for the first leaf below a node above the leaves.
  [[nodiscard]] unsigned has_below(NodeId node) const { return groups_[index_->leaf_groups_of(node).begin] & 1U; }

 private:
  void fill(const LeafGroupRange& range, NodeSet value) {
    std::fill(groups_.begin() + range.begin, groups_.begin() + range.end, value);
  }

  const IndexView* index_;
  std::vector<NodeSet> groups_;
  std::vector<LeafGroupRange> added_;
};

/// Marks what is known to be connected with the query vertex within the ball: whole nodes, in `GroupState::marked`, and
/// vertices of surface leaves. The marks spread over the links in a few passes. They are never wrong, but may be
/// incomplete: what has no mark then is *open*.
class HomeMarks {
 public:
  HomeMarks(const IndexView& index, const Kernels& kernels) : index_(&index), kernels_(&kernels), leaves_(index) {}

  void spread(const Query& query, Reach& reach);

  /// Marks some whole nodes of a group, or lanes of a surface leaf, that `spread` has left open.
  void add_nodes(std::uint32_t group, NodeSet nodes) { (*states_)[group].marked |= nodes; }
  void add_lanes(std::size_t place, LaneMask lanes) { lanes_[place] |= lanes; }

  /// Returns the marked lanes of a surface leaf, by its place. `lanes(surface_leaves().size())` may be read, too.
  [[nodiscard]] LaneMask lanes(std::size_t place) const { return lanes_[place]; }

  /// Returns 1 if a whole node that `spread` has marked is, or covers, the leaf, else 0.
  [[nodiscard]] unsigned has(LeafId leaf) const { return leaves_.has(leaf); }

  /// Return the groups with open nodes, in the order of `Reach::groups`, and the places of surface leaves with open
  /// lanes, ascending.
  [[nodiscard]] std::span<const std::uint32_t> open_groups() const { return open_groups_; }
  [[nodiscard]] std::span<const std::size_t> open_places() const { return open_places_; }

 private:
  void begin(const Query& query, const Reach& reach);
  void mark_nodes(std::uint32_t group);
  [[nodiscard]] unsigned covers(NodeId node) const;
  void keep_open(std::span<const std::uint32_t> groups);
  void mark_leaf(const Query& query, const LeafSubset& leaf, std::size_t place);

  const IndexView* index_;
  const Kernels* kernels_;
  GroupStates* states_ = nullptr;
  LeafBits leaves_;              // below marked nodes
  std::vector<LaneMask> lanes_;  // by place of a surface leaf, and one more
  std::vector<std::uint32_t> open_groups_;
  std::vector<std::size_t> open_places_;
};

}  // namespace meshhood::inline v0_1
