// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "exact/layout.h"
#include "exact/node_search.h"

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

  /// 1 if it has the leaf, else 0: for masks without branches, which could not be predicted.
  [[nodiscard]] unsigned has(LeafId leaf) const { return groups_[leaf / kFanOut] >> leaf % kFanOut & 1U; }

  /// The same for the first leaf below a node above the leaves.
  [[nodiscard]] unsigned has_below(NodeId node) const { return groups_[index_->leaf_groups_of(node).begin] & 1U; }

 private:
  void fill(const LeafGroupRange& range, NodeSet value) {
    std::fill(groups_.begin() + range.begin, groups_.begin() + range.end, value);
  }

  const IndexView* index_;
  std::vector<NodeSet> groups_;
  std::vector<LeafGroupRange> added_;
};

}  // namespace meshhood::inline v0_1
