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
  worklist_.run([&](GroupSlot slot) { take(group, packet, slot); });
}

void JointSpread::classify(const JointGroup& group, const Packet& packet) {
  slots_.resize(group.size());
  const std::span<const FrameSphere> spheres = group.spheres();
  for (GroupSlot slot = 0; slot < slots_.size(); ++slot) {
    const Containment side = group.is_core(slot) ? Containment::Inside : packet.classify(spheres[slot]);
    const bool is_whole =
        side == Containment::Inside && (group.is_core(slot) || index_->leaves[group.leaf(slot)].connected);
    const Kind kind = is_whole ? Kind::Whole : side == Containment::Outside ? Kind::Outside : Kind::Partial;
    slots_[slot] = {kind, kind == Kind::Outside, false, false, 0, 0};
  }
}

/// Each query begins at its own vertex.
void JointSpread::start(const JointGroup& group, const Packet& packet) {
  const GroupSlot slot = group.slot_of(packet.leaf());
  if (slots_[slot].kind == Kind::Whole) {
    add_to_whole(packet, slot, packet.queries());
    return;
  }
  slots_[slot].kind = Kind::Partial;
  slots_[slot].closed = false;
  PerLane<QueryWord>& words = pending(slot);
  for (std::size_t i = 0; i < packet.size(); ++i) words[packet.lane(i)] |= QueryWord{1} << i;
  worklist_.add(slot);
}

void JointSpread::take(JointGroup& group, const Packet& packet, GroupSlot slot) {
  if (slots_[slot].kind == Kind::Whole) {
    take_whole(group, packet, slot);
  } else {
    take_partial(group, packet, slot);
  }
}

void JointSpread::take_whole(const JointGroup& group, const Packet& packet, GroupSlot slot) {
  const QueryWord word = slots_[slot].word & ~slots_[slot].pushed;
  if (slots_[slot].pushed == 0) whole_.push_back(slot);
  slots_[slot].pushed |= word;
  if (group.is_core(slot)) {
    push_rim(group, packet, slot, word);
  } else {
    PerLane<QueryWord> reached;
    reached.fill(word);
    push_leaf(group, packet, group.leaf(slot), reached, ~LaneMask{0});
  }
}

void JointSpread::take_partial(JointGroup& group, const Packet& packet, GroupSlot slot) {
  Slot& state = slots_[slot];
  const LeafId leaf = group.leaf(slot);
  const Leaf& record = index_->leaves[leaf];
  const bool is_first = !state.has_inside;
  if (is_first) find_inside(group, packet, slot);
  const SpreadWords spread =
      kernels_->spread_words(words_[slot], &index_->adjacency[record.first], record.connected ? state.word : 0);
  state.closed = spread.closed;
  if (spread.gained == 0) return;
  if (state.pushed == 0) partial_.push_back({slot, record.first});
  state.pushed = packet.queries();
  push_leaf(group, packet, leaf, words_[slot].reached, spread.gained);
}

/// Which queries hold which vertices of the leaf.
void JointSpread::find_inside(JointGroup& group, const Packet& packet, GroupSlot slot) {
  slots_[slot].has_inside = true;
  const Leaf& record = index_->leaves[group.leaf(slot)];
  PerLane<QueryWord>& inside = words_[slot].inside;
  PerLane<QueryWord> doubts;
  const BallWords found =
      kernels_->ball_words(group.points(slot), first_lanes(record.size), packet.balls(), inside, doubts);
  slots_[slot].word = found.all;
  for (LaneMask lanes = found.in_doubt; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(lanes));
    const Point vertex = index_->position(group.leaf(slot), lane);
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
    const GroupSlot slot = group.slot_of(link.leaf);
    if (slot >= slots_.size() || slots_[slot].closed) continue;
    if (slots_[slot].kind == Kind::Whole) {
      QueryWord word = 0;
      for (LaneMask lanes = link.boundary; lanes != 0; lanes &= lanes - 1)
        word |= reached[static_cast<std::size_t>(std::countr_zero(lanes))];
      add_to_whole(packet, slot, word);
    } else {
      push_words(index_->cross_edges_of(link), reached, pending(slot));
      worklist_.add(slot);
    }
  }
}

void JointSpread::push_rim(const JointGroup& group, const Packet& packet, GroupSlot core, QueryWord word) {
  for (const JointGroup::RimLink& link : group.rim(core)) {
    if (slots_[link.slot].closed) continue;
    if (slots_[link.slot].kind == Kind::Whole) {
      add_to_whole(packet, link.slot, word);
    } else {
      PerLane<QueryWord>& words = pending(link.slot);
      for (LaneMask lanes = link.boundary; lanes != 0; lanes &= lanes - 1)
        words[static_cast<std::size_t>(std::countr_zero(lanes))] |= word;
      worklist_.add(link.slot);
    }
  }
}

void JointSpread::add_to_whole(const Packet& packet, GroupSlot slot, QueryWord word) {
  Slot& state = slots_[slot];
  if ((word & ~state.word) == 0) return;
  state.word |= word;
  state.closed = state.word == packet.queries();
  worklist_.add(slot);
}

PerLane<QueryWord>& JointSpread::pending(GroupSlot slot) {
  if (!slots_[slot].is_touched) {
    slots_[slot].is_touched = true;
    words_[slot].reached = {};
    words_[slot].pending = {};
  }
  return words_[slot].pending;
}

}  // namespace meshhood
