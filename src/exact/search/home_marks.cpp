// SPDX-License-Identifier: MIT
#include "exact/search/home_marks.h"

#include "exact/node_search.h"

namespace meshhood::inline v0_1 {

void HomeMarks::spread(const Query& query, Reach& reach) {
  states_ = &reach.states();
  leaves_.clear();
  begin(query, reach);
  for (const std::uint32_t group : reach.top_groups()) mark_nodes(group);
  for (const std::uint32_t group : reach.lower_groups()) mark_nodes(group);
  // A group sees the marks of those before it only. Chosen: a fourth pass would find few more.
  keep_open(reach.groups());
  for (int pass = 0; pass < 2; ++pass) {
    for (const std::uint32_t group : open_groups_) mark_nodes(group);
    keep_open(open_groups_);
  }
  const std::span<const LeafSubset> leaves = reach.surface_leaves();
  lanes_.resize(leaves.size() + 1);
  open_places_.clear();
  for (std::size_t place = 0; place < leaves.size(); ++place) mark_leaf(query, leaves[place], place);
}

/// Marks the whole nodes at the query vertex.
void HomeMarks::begin(const Query& query, const Reach& reach) {
  const auto mark = [&](LeafId leaf) {
    const NodeId whole = states_->whole_node(leaf);
    if (whole != kNoNode) (*states_)[whole / kFanOut].marked |= node_at(whole % kFanOut);
  };
  mark(query.leaf());
  const std::size_t place = reach.place_of(query.leaf());
  if (place == Reach::kNoPlace) return;
  const LaneMask* adjacency = &index_->adjacency[index_->leaves[query.leaf()].first];
  const LaneMask piece = kernels_->reachable(adjacency, reach.surface_leaves()[place].lanes, query.lane());
  for (const Link& link : index_->links_of(query.leaf())) {
    if ((link.boundary & piece) != 0) mark(link.leaf);
  }
}

/// Spreads the marks to the whole nodes of a group, from its own and from those that its links lead to: nodes of the
/// same level, or larger ones that cover them.
void HomeMarks::mark_nodes(std::uint32_t group) {
  GroupState& state = (*states_)[group];
  if (state.whole == 0) return;
  const GroupRecord& record = index_->records[group];
  unsigned linked = state.marked;
  if (index_->is_of_leaves(group)) {
    for (const NodeLink& link : index_->node_links_of(record)) linked |= link.mine & (0U - leaves_.has(link.node()));
  } else {
    for (const NodeLink& link : index_->node_links_of(record)) linked |= link.mine & (0U - covers(link.node()));
  }
  state.marked = reachable_nodes(record.linked, static_cast<NodeSet>(linked & state.whole), state.whole);
  leaves_.add(group, state.marked);
}

/// Returns 1 if a node above the leaves, or a larger one that covers it, has a mark, else 0.
unsigned HomeMarks::covers(NodeId node) const {
  // A node of a known group may have marks below it that are not its own.
  if (states_->is_known(node / kFanOut)) return (*states_)[node / kFanOut].marked >> node % kFanOut & 1U;
  return leaves_.has_below(node);
}

/// Keeps those of `groups` that have whole nodes without a mark.
void HomeMarks::keep_open(std::span<const std::uint32_t> groups) {
  if (open_groups_.size() < groups.size()) open_groups_.resize(groups.size());
  std::size_t kept = 0;
  for (const std::uint32_t group : groups) {
    open_groups_[kept] = group;
    kept += static_cast<std::size_t>((*states_)[group].whole != (*states_)[group].marked);
  }
  open_groups_.resize(kept);
}

/// Marks the vertices of a surface leaf that are connected with a marked node within the leaf.
void HomeMarks::mark_leaf(const Query& query, const LeafSubset& leaf, std::size_t place) {
  LaneMask linked = leaf.leaf == query.leaf() ? query.lane() : 0;
  for (const Link& link : index_->links_of(leaf.leaf)) linked |= link.boundary & (0U - leaves_.has(link.leaf));
  linked &= leaf.lanes;
  if (linked != 0 && linked != leaf.lanes) {
    linked = kernels_->reachable(&index_->adjacency[index_->leaves[leaf.leaf].first], leaf.lanes, linked);
  }
  lanes_[place] = linked;
  if (linked != leaf.lanes) open_places_.push_back(place);
}

}  // namespace meshhood::inline v0_1
