// SPDX-License-Identifier: MIT
#include "exact/search/home_marks.h"

#include "exact/node_search.h"

namespace meshhood {

void HomeMarks::mark(NodeId node, GroupStates& states) const {
  const NodeId whole = states.whole_node(node);
  if (whole == kNoNode) return;
  const Patch patch = patch_of(whole, states);
  states[patch.group].home |= patch.nodes;
}

bool HomeMarks::leads_home(NodeId node, GroupStates& states) {
  const NodeId whole = states.whole_node(node);
  if (whole == kNoNode) return false;
  const GroupState& state = states[whole / kFanOut];
  const NodeSet bit = node_at(whole % kFanOut);
  if ((state.home & bit) != 0) return true;
  return (state.explored & bit) == 0 && explore(whole, states);
}

/// Breadth-first search from a whole node to a marked one.
bool HomeMarks::explore(NodeId whole, GroupStates& states) {
  visited_.clear();
  bool is_home = visit(whole, states);
  for (std::size_t i = 0; !is_home && i < visited_.size(); ++i) {
    const Patch patch = visited_[i];  // a copy, because `visited_` grows
    is_home = visit_linked(patch, states);
  }
  if (is_home) {
    for (const Patch& patch : visited_) states[patch.group].home |= patch.nodes;
  }
  return is_home;
}

/// Visits the patch of a whole node. Returns whether a node of it is marked.
bool HomeMarks::visit(NodeId whole, GroupStates& states) {
  const Patch patch = patch_of(whole, states);
  GroupState& state = states[patch.group];
  state.explored |= patch.nodes;
  visited_.push_back(patch);
  return (patch.nodes & state.home) != 0;
}

/// Visits what the patch is linked with. Returns true as soon as a node of it is marked.
bool HomeMarks::visit_linked(const Patch& patch, GroupStates& states) {
  for (const NodeLink& link : index_->node_links_of(index_->records[patch.group])) {
    if ((link.mine & patch.nodes) == 0) continue;  // mutant: link-of-another-node-followed
    const NodeId other = states.whole_node(link.node());
    if (other == kNoNode) continue;
    const GroupState& state = states[other / kFanOut];
    const NodeSet bit = node_at(other % kFanOut);
    if ((state.home & bit) != 0) return true;
    // The nodes explored without success do not lead to a mark.
    if ((state.explored & bit) == 0 && visit(other, states)) return true;
  }
  return false;
}

bool HomeMarks::smaller_leads_home(NodeId whole, GroupStates& states) {
  const Patch patch = patch_of(whole, states);
  const GroupRecord& record = index_->records[patch.group];
  NodeSet beside = 0;
  for_each_node(patch.nodes, [&](unsigned i) { beside |= record.linked[i]; });
  bool is_home = false;
  for_each_node(beside, [&](unsigned i) {
    is_home = is_home || smaller_leads_home_below(patch.group * kFanOut + i, patch, states);
  });
  for (const NodeLink& link : index_->node_links_of(record)) {
    if (is_home) break;
    is_home = (link.mine & patch.nodes) != 0 && smaller_leads_home_below(link.node(), patch, states);
  }
  if (is_home) states[patch.group].home |= patch.nodes;
  return is_home;
}

/// Whether a whole node below `node` is linked with the patch and leads home.
bool HomeMarks::smaller_leads_home_below(NodeId node, const Patch& patch, GroupStates& states) {
  const std::uint32_t group = node / kFanOut;
  if (node < index_->leaf_count() || !states.is_known(group)) return false;
  if ((states[group].intersecting & node_at(node % kFanOut)) == 0) return false;
  const std::uint32_t below = index_->records[group].first_child + node % kFanOut;
  const GroupState& state = states[below];
  bool is_home = false;
  for (const NodeLink& link : index_->node_links_of(index_->records[below])) {
    const NodeId whole = states.whole_node(link.node());
    // mutant: neighbor-of-any-node-asked
    if (whole == kNoNode || whole / kFanOut != patch.group || (patch.nodes & node_at(whole % kFanOut)) == 0) continue;
    for_each_node(link.mine & state.whole,
                  [&](unsigned i) { is_home = is_home || leads_home(below * kFanOut + i, states); });
    for_each_node(link.mine & state.intersecting, [&](unsigned i) {
      is_home = is_home || smaller_leads_home_below(below * kFanOut + i, patch, states);
    });
    if (is_home) break;
  }
  return is_home;
}

/// The patch of a whole node.
HomeMarks::Patch HomeMarks::patch_of(NodeId whole, const GroupStates& states) const {
  const std::uint32_t group = whole / kFanOut;
  // mutant: home-mark-skips-the-outside
  return {group, reachable_nodes(index_->records[group].linked, node_at(whole % kFanOut), states[group].whole)};
}

}  // namespace meshhood
