// SPDX-License-Identifier: MIT
#include "exact/search/home_marks.h"

#include <bit>

#include "base/prefetch.h"
#include "exact/node_search.h"

namespace meshhood {

namespace {

/// Whether a whole node in doubt is not marked.
bool has_doubt(const GroupState& state) { return (state.whole & state.in_doubt & ~state.home) != 0; }

}  // namespace

bool HomeMarks::mark(NodeId node, GroupStates& states) const {
  const NodeId whole = states.whole_node(node);
  if (whole == kNoNode) return false;
  GroupState& state = states[whole / kFanOut];
  if ((state.home >> whole % kFanOut & 1U) != 0) return false;
  const auto bit = static_cast<NodeSet>(1U << whole % kFanOut);
  // mutant: home-mark-skips-the-outside
  state.home |= reachable_nodes(index_->records[whole / kFanOut].linked, bit, state.whole);
  return true;
}

void HomeMarks::begin(NodeId leaf, GroupStates& states) {
  gained_.clear();
  const NodeId whole = states.whole_node(leaf);
  if (whole == kNoNode) return;
  static_cast<void>(mark(whole, states));
  push(whole / kFanOut, states);
}

void HomeMarks::spread(std::span<const std::uint32_t> groups, GroupStates& states) {
  unmarked_.clear();
  // Each leaf in doubt takes longer to test than a group to mark.
  if (2 * count_doubts(groups, states) < groups.size()) return;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i + kGroupsAhead < groups.size()) prefetch_links(groups[i + kGroupsAhead], states);
    if (!pull(groups[i], states) && has_doubt(states[groups[i]])) unmarked_.push_back(groups[i]);
  }
  if (unmarked_.empty()) return;
  gained_.clear();
  for (const std::uint32_t group : groups) {
    if (states[group].home != 0) gained_.push_back(group);
  }
  pull_unmarked(states);
  // A larger node does not see the smaller ones beside it, so these push. The first of `unmarked_` are the largest.
  const std::size_t leaf_groups = index_->leaf_count() / kFanOut;
  while (!gained_.empty() && !unmarked_.empty() && unmarked_.front() >= leaf_groups) {
    for (std::size_t head = 0; head < gained_.size(); ++head) push(gained_[head], states);
    gained_.clear();
    pull_unmarked(states);
  }
}

/// Pulls until no group of `unmarked_` gains a mark.
void HomeMarks::pull_unmarked(GroupStates& states) {
  for (std::size_t before = gained_.size() + 1; gained_.size() != before;) {
    before = gained_.size();
    std::erase_if(unmarked_, [&](std::uint32_t group) {
      const NodeSet home = states[group].home;
      const bool is_settled = pull(group, states);
      if (states[group].home != home) gained_.push_back(group);
      return is_settled;
    });
  }
}

/// The number of nodes that are in doubt and not marked: whole ones, and leaves that intersect the ball.
std::size_t HomeMarks::count_doubts(std::span<const std::uint32_t> groups, const GroupStates& states) const {
  const std::size_t leaf_groups = index_->leaf_count() / kFanOut;
  std::size_t doubts = 0;
  for (const std::uint32_t group : groups) {
    const GroupState& state = states[group];
    const unsigned surface_leaves = group < leaf_groups ? state.intersecting : 0U;
    doubts += static_cast<std::size_t>(
        std::popcount(state.in_doubt & ((state.whole & ~unsigned{state.home}) | surface_leaves)));
  }
  return doubts;
}

/// Marks the whole nodes of a group that are linked with a marked one of its level, or with one that covers such.
/// Returns whether all are marked.
bool HomeMarks::pull(std::uint32_t group, GroupStates& states) const {
  GroupState& state = states[group];
  if (state.whole == state.home) return true;
  const GroupRecord& record = index_->records[group];
  for (const NodeLink& link : index_->node_links_of(record)) {
    const auto open = static_cast<NodeSet>(link.mine & state.whole & ~state.home);
    if (open == 0 || !states.is_home(link.node())) continue;
    state.home |= reachable_nodes(record.linked, open, state.whole);
    if (state.whole == state.home) return true;
  }
  return false;
}

/// Marks the whole nodes that the marked nodes of a group are linked with: of its level, or larger.
void HomeMarks::push(std::uint32_t group, GroupStates& states) {
  const NodeSet home = states[group].home;
  if (home == 0) return;
  for (const NodeLink& link : index_->node_links_of(index_->records[group])) {
    if ((link.mine & home) == 0) continue;
    const NodeId whole = states.whole_node(link.node());
    if (whole != kNoNode && mark(whole, states)) gained_.push_back(whole / kFanOut);
  }
}

void HomeMarks::prefetch_links(std::uint32_t group, const GroupStates& states) const {
  if (states[group].whole != 0) fetch_lines(index_->node_links.data() + index_->records[group].first_link, 2);
}

}  // namespace meshhood
