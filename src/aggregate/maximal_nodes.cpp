// SPDX-License-Identifier: MIT
#include "aggregate/maximal_nodes.h"

#include <algorithm>

namespace meshhood {

void MaximalNodes::reduce(const PacketAnswer& packet, PacketReducer& reducer) {
  reducer.begin(packet);
  families_.clear();
  numbers_.clear();
  parents_.clear();
  for (const CoreLeaves& core : packet.cores) {
    for (const LeafRun& run : core.runs) add_run(run, core.queries);
  }
  for (const WholeLeaves& whole : packet.whole) add_run(whole.run, whole.queries);
  for (const PartialLeaf& leaf : packet.partial) {
    family_with(leaf.leaf, numbers_).parts[leaf.leaf % kFanOut] = &leaf;
  }
  std::sort(numbers_.begin(), numbers_.end());
  // Children have smaller numbers than their parents, and the order of parents is that of their children.
  for (std::size_t i = 0, j = 0; i < numbers_.size() || j < parents_.size();) {
    const bool is_parent = i == numbers_.size() || (j < parents_.size() && parents_[j] < numbers_[i]);
    const std::uint32_t number = is_parent ? parents_[j++] : numbers_[i++];
    pass_on(number, reducer);
  }
  for (const std::uint32_t number : numbers_) family_of_[number] = kNone;
  for (const std::uint32_t number : parents_) family_of_[number] = kNone;
}

/// The family of a node. A new one is noted in `numbers`.
MaximalNodes::Family& MaximalNodes::family_with(NodeTree::Node node, std::vector<std::uint32_t>& numbers) {
  const std::uint32_t number = NodeTree::family(node);
  if (family_of_[number] == kNone) {
    family_of_[number] = static_cast<std::uint32_t>(families_.size());
    families_.emplace_back();
    numbers.push_back(number);
  }
  return families_[family_of_[number]];
}

void MaximalNodes::add_run(const LeafRun& run, QueryWord queries) {
  tree_->for_each_node(run,
                       [&](NodeTree::Node node) { family_with(node, numbers_).queries[node % kFanOut] |= queries; });
}

/// Passes on the parts of leaves and the nodes of a family, without the rows that have the parent: it gets these.
void MaximalNodes::pass_on(std::uint32_t number, PacketReducer& reducer) {
  Family family = families_[family_of_[number]];
  const NodeTree::Children nodes = tree_->members(number);
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (family.parts[k] != nullptr) pass_on_part(*family.parts[k], family.queries[k], reducer);
    of_all &= family.queries[k];
  }
  const NodeTree::Node parent = tree_->parent(number);
  if (parent == kNoNode) of_all = 0;
  if (of_all != 0) family_with(parent, parents_).queries[parent % kFanOut] |= of_all;
  QueryWord any = 0;
  for (QueryWord& word : family.queries) {
    word &= ~of_all;  // mutant: node-and-its-parent
    any |= word;
  }
  if (any != 0) reducer.add_nodes(nodes, family.queries.data());
}

/// Passes on the vertices of a leaf, without the rows that have all of them: these are added to `whole`.
void MaximalNodes::pass_on_part(const PartialLeaf& leaf, QueryWord& whole, PacketReducer& reducer) {
  const std::size_t size = leaf.vertices.size();
  QueryWord of_all = ~QueryWord{0};
  for (std::size_t k = 0; k < size; ++k) of_all &= leaf.queries[k];
  whole |= of_all;
  PerLane<QueryWord> words;
  QueryWord any = 0;
  for (std::size_t k = 0; k < words.size(); ++k) {
    words[k] = leaf.queries[k] & ~of_all;  // mutant: whole-leaf-in-parts
    any |= words[k];
  }
  if (any != 0) reducer.add_leaf(leaf.vertices, words.data());
}

}  // namespace meshhood
