// SPDX-License-Identifier: MIT
#include "exact/joint/spread.h"

#include <algorithm>
#include <bit>

namespace meshhood::inline v0_1 {

void JointSpread::run(JointGroup& group, const Packet& packet) {
  whole_.clear();
  partial_.clear();
  worklist_.reset(group.size());
  if (words_.size() < group.size()) words_.resize(group.size() + group.size() / 2);
  classify(group, packet);
  start(group, packet);
  worklist_.run([&](GroupEntry entry) { take(group, packet, entry); });
  if (!index_->ignored.empty()) leave_out_ignored(group);
}

/// Takes the ignored vertices out of what was reached. A leaf that has some gets words; a core has none.
void JointSpread::leave_out_ignored(const JointGroup& group) {
  for (const LeafOfWords& found : partial_) {
    for_each_lane(index_->ignored[group.leaf(found.words)],
                  [&](unsigned lane) { words_[found.words].reached[lane] = 0; });
  }
  std::erase_if(whole_, [&](GroupEntry entry) {
    if (group.is_core(entry) || index_->ignored[group.leaf(entry)] == 0) return false;
    const LeafId leaf = group.leaf(entry);
    words_[entry].reached = {};
    for_each_lane(first_lanes(index_->leaves[leaf].size) & ~index_->ignored[leaf],
                  [&](unsigned lane) { words_[entry].reached[lane] = states_[entry].word; });
    partial_.push_back({entry, index_->leaves[leaf].first});
    return true;
  });
}

void JointSpread::classify(const JointGroup& group, const Packet& packet) {
  const std::span<const Group> spheres = group.spheres();
  for (auto next = static_cast<std::uint32_t>(numbers_.size()); next < spheres.size(); ++next) numbers_.push_back(next);
  sides_.resize(spheres.size());
  tree_kernels_->classify(spheres.data(), std::span(numbers_).first(spheres.size()), packet.ball(), sides_.data());
  states_.resize(group.size());
  for (GroupEntry entry = 0; entry < states_.size(); ++entry) {
    const JointGroup::Eight eight = group.eights()[entry / kFanOut];
    const GroupContainment& side = sides_[entry / kFanOut];
    const auto has = [&](unsigned bits) { return (bits >> entry % kFanOut & 1U) != 0; };
    const bool is_whole = has((side.inside & eight.connected) | eight.cores);
    const bool is_outside = !has(side.inside | side.intersecting | eight.cores);
    const Kind kind = is_whole ? Kind::Whole : is_outside ? Kind::Outside : Kind::Partial;
    states_[entry] = {kind, is_outside, false, false, 0, 0};
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

/// Pushes one word to an entry; `f` puts it into the pending words of a partial one.
template <class F>
void JointSpread::push(const Packet& packet, GroupEntry entry, QueryWord word, F&& f) {
  if (states_[entry].closed) return;
  if (states_[entry].kind == Kind::Whole) {
    add_to_whole(packet, entry, word);
  } else {
    f(pending(entry));
    worklist_.add(entry);
  }
}

void JointSpread::take_whole(JointGroup& group, const Packet& packet, GroupEntry entry) {
  const QueryWord word = states_[entry].word & ~states_[entry].pushed;
  if (states_[entry].pushed == 0) whole_.push_back(entry);
  states_[entry].pushed |= word;
  if (group.is_core(entry)) {
    for (const JointGroup::CoreLink& link : group.core_links(entry)) {
      push(packet, link.entry, word, [&](PerLane<QueryWord>& pending) {
        for_each_lane(link.far_boundary, [&](unsigned lane) { pending[lane] |= word; });
      });
    }
  } else {
    for (const JointGroup::EntryLink& link : group.links(entry)) {
      push(packet, link.entry, word, [&](PerLane<QueryWord>& pending) {
        for (const CrossEdge& edge : link.edges) pending[edge.to] |= word;
      });
    }
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
  push_leaf(group, packet, entry, spread.gained);
}

/// Which queries hold which vertices of the leaf.
void JointSpread::find_inside(JointGroup& group, const Packet& packet, GroupEntry entry) {
  states_[entry].has_inside = true;
  const LeafId leaf = group.leaf(entry);
  PerLane<QueryWord>& inside = words_[entry].inside;
  PerLane<QueryWord> doubts;
  const BallWords found =
      kernels_->ball_words(group.points(entry), index_->open_lanes(leaf), packet.balls(), inside, doubts);
  states_[entry].word = found.all;
  for_each_lane(found.in_doubt, [&](unsigned lane) {
    const Point vertex = index_->position(leaf, lane);
    for_each_query(doubts[lane],
                   [&](std::size_t query) { inside[lane] |= QueryWord{packet.holds(query, vertex)} << query; });
  });
}

/// Pushes the words of a leaf over its links. Which links take them cannot be predicted, so they are chosen first,
/// without branches.
void JointSpread::push_leaf(JointGroup& group, const Packet& packet, GroupEntry entry, LaneMask gained) {
  constexpr std::size_t kAtOnce = 64;
  for (std::span<const JointGroup::EntryLink> links = group.links(entry); !links.empty();) {
    const std::span<const JointGroup::EntryLink> some = links.first(std::min(links.size(), kAtOnce));
    std::uint64_t taken = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const bool has_gained = (some[i].boundary & gained) != 0;
      const bool is_open = !states_[some[i].entry].closed;
      taken |= static_cast<std::uint64_t>(has_gained & is_open) << i;
    }
    for (; taken != 0; taken &= taken - 1) {
      push_over(packet, words_[entry].reached, some[static_cast<std::size_t>(std::countr_zero(taken))]);
    }
    links = links.subspan(some.size());
  }
}

void JointSpread::push_over(const Packet& packet, const PerLane<QueryWord>& reached,
                            const JointGroup::EntryLink& link) {
  if (states_[link.entry].kind == Kind::Whole) {
    QueryWord word = 0;
    for_each_lane(link.boundary, [&](unsigned lane) { word |= reached[lane]; });
    add_to_whole(packet, link.entry, word);
  } else {
    push_words(link.edges, reached, pending(link.entry));
    worklist_.add(link.entry);
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
    kernels_->clear_words(words_[entry]);
  }
  return words_[entry].pending;
}

}  // namespace meshhood::inline v0_1
