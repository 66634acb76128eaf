// SPDX-License-Identifier: MIT
#include "aggregate/maximal_nodes.h"

#include <algorithm>

namespace meshhood::inline v0_1 {

void MaximalNodes::reduce(const PacketAnswer& packet, PacketReducer& reducer) {
  reducer.begin(packet);
  if (!reducer.takes_nodes()) return pass_on_leaves(packet, reducer);
  rows_.clear();
  named_.clear();
  parents_.clear();
  for (const Piece& piece : packet.pieces) {
    if (piece.is_run()) {
      add_run(piece.leaves, piece.queries);
    } else {
      group_with(piece.leaves.begin, named_).parts[piece.leaves.begin % kFanOut] = piece.reached;
    }
  }
  std::sort(named_.begin(), named_.end());
  // The groups of children have smaller numbers than those of their parents, and the same order.
  for (std::size_t i = 0, j = 0; i < named_.size() || j < parents_.size();) {
    const bool is_parent = i == named_.size() || (j < parents_.size() && parents_[j] < named_[i]);
    const std::uint32_t group = is_parent ? parents_[j++] : named_[i++];
    pass_on(group, reducer);
  }
  for (const std::uint32_t group : named_) place_of_[group] = kNone;
  for (const std::uint32_t group : parents_) place_of_[group] = kNone;
}

void MaximalNodes::pass_on_leaves(const PacketAnswer& packet, PacketReducer& reducer) const {
  PerLane<QueryWord> words;
  for (const Piece& piece : packet.pieces) {
    words.fill(piece.queries);
    for (NodeTree::Node leaf = piece.leaves.begin; leaf < piece.leaves.end; ++leaf) {
      reducer.add_leaf(tree_->vertices(leaf), piece.is_run() ? words.data() : piece.reached);
    }
  }
}

/// The rows of the group of a node. A new one is noted in `groups`.
MaximalNodes::GroupRows& MaximalNodes::group_with(NodeTree::Node node, std::vector<std::uint32_t>& groups) {
  const std::uint32_t group = NodeTree::group(node);
  if (place_of_[group] == kNone) {
    place_of_[group] = static_cast<std::uint32_t>(rows_.size());
    rows_.emplace_back();
    groups.push_back(group);
  }
  return rows_[place_of_[group]];
}

void MaximalNodes::add_run(const LeafRun& run, QueryWord queries) {
  tree_->for_each_node(run, [&](NodeTree::Node node) { group_with(node, named_).queries[node % kFanOut] |= queries; });
}

/// Passes on the parts of leaves and the nodes of a group, without the rows that have the parent: it gets these.
void MaximalNodes::pass_on(std::uint32_t group, PacketReducer& reducer) {
  GroupRows rows = rows_[place_of_[group]];
  const NodeTree::Children nodes = tree_->members(group);
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (rows.parts[k] != nullptr)
      pass_on_part(tree_->vertices(nodes.begin + static_cast<NodeTree::Node>(k)), rows.parts[k], rows.queries[k],
                   reducer);
    of_all &= rows.queries[k];
  }
  const NodeTree::Node parent = tree_->parent(group);
  if (parent == kNoNode) of_all = 0;
  if (of_all != 0) group_with(parent, parents_).queries[parent % kFanOut] |= of_all;
  QueryWord any = 0;
  for (QueryWord& word : rows.queries) {
    word &= ~of_all;
    any |= word;
  }
  if (any != 0) reducer.add_nodes(nodes, rows.queries.data());
}

/// Passes on the vertices of a leaf, without the rows that have all of them: these are added to `whole`.
void MaximalNodes::pass_on_part(const VertexRange& vertices, const QueryWord* reached, QueryWord& whole,
                                PacketReducer& reducer) {
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < vertices.size(); ++k) of_all &= reached[k];
  whole |= of_all;
  PerLane<QueryWord> words;
  QueryWord any = 0;
  for (std::size_t k = 0; k < words.size(); ++k) {
    words[k] = reached[k] & ~of_all;
    any |= words[k];
  }
  if (any != 0) reducer.add_leaf(vertices, words.data());
}

}  // namespace meshhood::inline v0_1
