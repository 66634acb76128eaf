// SPDX-License-Identifier: MIT
#include "exact/joint/spread.h"

#include <bit>

namespace meshhood {

void JointSpread::run(JointGroup& group, const Packet& packet) {
  whole_.clear();
  partial_.clear();
  worklist_.reset(group.size());
  if (words_.size() < group.size()) words_.resize(group.size() + group.size() / 2);
  classify(group, packet);
  start(group, packet);
  worklist_.run([&](GroupEntry entry) { take(group, packet, entry); });
}

void JointSpread::classify(const JointGroup& group, const Packet& packet) {
  states_.resize(group.size());
  const std::span<const FrameSphere> spheres = group.spheres();
  for (GroupEntry entry = 0; entry < states_.size(); ++entry) {
    const Containment side = group.is_core(entry) ? Containment::Inside : packet.classify(spheres[entry]);
    const bool is_whole =
        side == Containment::Inside && (group.is_core(entry) || index_->leaves[group.leaf(entry)].connected);
    const Kind kind = is_whole ? Kind::Whole : side == Containment::Outside ? Kind::Outside : Kind::Partial;
    states_[entry] = {kind, kind == Kind::Outside, false, false, 0, 0};
  }
}

/// Each query begins at its own vertex.
void JointSpread::start(const JointGroup& group, const Packet& packet) {
  const GroupEntry entry = group.entry_of(packet.leaf());
  if (states_[entry].kind == Kind::Whole) {
    add_to_whole(packet, entry, packet.queries());
    return;
  }
  states_[entry].kind = Kind::Partial;
  states_[entry].closed = false;
  PerLane<QueryWord>& words = pending(entry);
  for (std::size_t i = 0; i < packet.size(); ++i) words[packet.lane(i)] |= QueryWord{1} << i;
  worklist_.add(entry);
}

void JointSpread::take(JointGroup& group, const Packet& packet, GroupEntry entry) {
  if (states_[entry].kind == Kind::Whole) {
    take_whole(group, packet, entry);
  } else {
    take_partial(group, packet, entry);
  }
}

void JointSpread::take_whole(const JointGroup& group, const Packet& packet, GroupEntry entry) {
  const QueryWord word = states_[entry].word & ~states_[entry].pushed;
  if (states_[entry].pushed == 0) whole_.push_back(entry);
  states_[entry].pushed |= word;
  if (group.is_core(entry)) {
    push_rim(group, packet, entry, word);
  } else {
    PerLane<QueryWord> reached;
    reached.fill(word);
    push_leaf(group, packet, group.leaf(entry), reached, ~LaneMask{0});
  }
}

void JointSpread::take_partial(JointGroup& group, const Packet& packet, GroupEntry entry) {
  State& state = states_[entry];
  const LeafId leaf = group.leaf(entry);
  const Leaf& record = index_->leaves[leaf];
  const bool is_first = !state.has_inside;
  if (is_first) find_inside(group, packet, entry);
  const SpreadWords spread =
      kernels_->spread_words(words_[entry], &index_->adjacency[record.first], record.connected ? state.word : 0);
  state.closed = spread.closed;
  if (spread.gained == 0) return;
  if (state.pushed == 0) partial_.push_back({entry, record.first});
  state.pushed = packet.queries();
  push_leaf(group, packet, leaf, words_[entry].reached, spread.gained);
}

/// Which queries hold which vertices of the leaf.
void JointSpread::find_inside(JointGroup& group, const Packet& packet, GroupEntry entry) {
  states_[entry].has_inside = true;
  const Leaf& record = index_->leaves[group.leaf(entry)];
  PerLane<QueryWord>& inside = words_[entry].inside;
  PerLane<QueryWord> doubts;
  const BallWords found =
      kernels_->ball_words(group.points(entry), first_lanes(record.size), packet.balls(), inside, doubts);
  states_[entry].word = found.all;
  for (LaneMask lanes = found.in_doubt; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(lanes));
    const Point vertex = index_->position(group.leaf(entry), lane);
    for (QueryWord left = doubts[lane]; left != 0; left &= left - 1) {
      const auto query = static_cast<unsigned>(std::countr_zero(left));
      inside[lane] |= QueryWord{packet.holds(query, vertex)} << query;
    }
  }
}

void JointSpread::push_leaf(const JointGroup& group, const Packet& packet, LeafId leaf,
                            const PerLane<QueryWord>& reached, LaneMask gained) {
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & gained) == 0) continue;
    const GroupEntry entry = group.entry_of(link.leaf);
    if (entry >= states_.size() || states_[entry].closed) continue;
    if (states_[entry].kind == Kind::Whole) {
      QueryWord word = 0;
      for (LaneMask lanes = link.boundary; lanes != 0; lanes &= lanes - 1)
        word |= reached[static_cast<std::size_t>(std::countr_zero(lanes))];
      add_to_whole(packet, entry, word);
    } else {
      push_words(index_->cross_edges_of(link), reached, pending(entry));
      worklist_.add(entry);
    }
  }
}

void JointSpread::push_rim(const JointGroup& group, const Packet& packet, GroupEntry core, QueryWord word) {
  for (const JointGroup::RimLink& link : group.rim(core)) {
    if (states_[link.entry].closed) continue;
    if (states_[link.entry].kind == Kind::Whole) {
      add_to_whole(packet, link.entry, word);
    } else {
      PerLane<QueryWord>& words = pending(link.entry);
      for (LaneMask lanes = link.boundary; lanes != 0; lanes &= lanes - 1)
        words[static_cast<std::size_t>(std::countr_zero(lanes))] |= word;
      worklist_.add(link.entry);
    }
  }
}

void JointSpread::add_to_whole(const Packet& packet, GroupEntry entry, QueryWord word) {
  State& state = states_[entry];
  if ((word & ~state.word) == 0) return;
  state.word |= word;
  state.closed = state.word == packet.queries();
  worklist_.add(entry);
}

PerLane<QueryWord>& JointSpread::pending(GroupEntry entry) {
  if (!states_[entry].is_touched) {
    states_[entry].is_touched = true;
    words_[entry].reached = {};
    words_[entry].pending = {};
  }
  return words_[entry].pending;
}

}  // namespace meshhood
