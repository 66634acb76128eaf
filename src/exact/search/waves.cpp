// SPDX-License-Identifier: MIT
#include "exact/search/waves.h"

#include <utility>

#include "base/prefetch.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {

void Waves::run(NodeId home, const TreeBall& ball, GroupStates& states) {
  groups_.clear();
  next_wave_.clear();
  meet(home, states);
  for (std::size_t placed = 0; !next_wave_.empty();) {
    std::swap(wave_, next_wave_);
    next_wave_.clear();
    place(placed, ball, states);
    placed = groups_.size();
    for (const std::uint32_t group : wave_) spread(group, states);
  }
  // What was not reached is not connected with the query vertex. To look at it again would only take time.
  for (const std::uint32_t group : groups_) {
    GroupState& state = states[group];
    state.whole &= state.reached;
    state.intersecting &= state.reached;
  }
}

/// Makes a node pending that is linked with a reached one.
void Waves::meet(NodeId node, GroupStates& states) {
  const std::uint32_t group = node / kFanOut;
  const NodeSet bit = node_at(node % kFanOut);
  if (!states.is_known(group)) {
    states.set(group, {}).pending = bit;
    groups_.push_back(group);
    next_wave_.push_back(group);
    fetch_lines(&index_->groups[group], sizeof(Group) / kCacheLine);
    prefetch(&index_->records[group]);
    return;
  }
  GroupState& state = states[group];
  if ((state.reached & bit) != 0) return;
  if (state.pending == 0) next_wave_.push_back(group);
  state.pending |= bit;
}

/// Compares the groups met since the last wave with the ball.
void Waves::place(std::size_t first_new, const TreeBall& ball, GroupStates& states) {
  const auto met = std::span(groups_).subspan(first_new);
  if (containments_.size() < met.size()) containments_.resize(2 * met.size());
  kernels_->classify(index_->groups.data(), met, ball, containments_.data());
  for (std::size_t i = 0; i < met.size(); ++i) {
    GroupState& state = states[met[i]];
    const GroupRecord& record = index_->records[met[i]];
    state.place(record, containments_[i]);
    fetch_lines(index_->node_links.data() + record.first_link, 2);
  }
}

/// Reaches what is pending in the group and what is linked with it there, and meets their links.
void Waves::spread(std::uint32_t group, GroupStates& states) {
  const GroupRecord& record = index_->records[group];
  GroupState& state = states[group];
  const auto open = static_cast<NodeSet>((state.whole | state.intersecting) & ~state.reached);
  const NodeSet from = state.pending & open;
  state.pending = 0;
  if (from == 0) return;
  const NodeSet added = reachable_nodes(record.linked, from, open);
  state.reached |= added;
  for (const NodeLink& link : index_->node_links_of(record)) {
    if ((link.mine & added) != 0) meet(link.node(), states);
  }
}

}  // namespace meshhood::inline v0_1
