// SPDX-License-Identifier: MIT
#include "exact/joint/ring_packet.h"

#include <algorithm>
#include <cassert>

namespace meshhood::inline v0_1 {

void RingPacket::run(LeafId leaf, std::span<const RingQuery> queries) {
  assert(!queries.empty() && queries.size() <= kPacketCapacity);
  entries_.forget();
  states_.clear();
  active_.clear();
  queries_ = first_lanes(static_cast<unsigned>(queries.size()));
  const Entry own = entry_of(leaf);
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    words_[own].pending[queries[i].lane] |= QueryWord{1} << i;
    most = std::max(most, queries[i].rings);
  }
  pending_.assign(1, own);
  step(0, queries_);
  for (std::uint32_t ring = 1; ring <= most && !active_.empty(); ++ring) {
    QueryWord alive = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) alive |= QueryWord{queries[i].rings >= ring} << i;
    pending_ = active_;
    for (const Entry entry : active_) states_[entry].is_pending = true;
    for (const Entry entry : active_) push(entry);
    step(ring, alive);
  }
  finish();
}

/// That of a leaf, which is made when the search first meets it.
RingPacket::Entry RingPacket::entry_of(LeafId leaf) {
  if (entries_.is_known(leaf)) return entries_[leaf];
  const auto entry = static_cast<Entry>(states_.size());
  entries_.set(leaf, entry);
  states_.push_back({leaf, index_->leaf_begin[leaf], index_->open_lanes(leaf), 0, false, false});
  if (words_.size() <= entry) {
    words_.resize(2 * states_.size());
    fresh_.resize(2 * states_.size());
    edges_.resize(2 * states_.size());
  }
  kernels_->clear_words(words_[entry]);
  return entry;
}

/// Pushes the fresh words of a leaf over its links.
void RingPacket::push(Entry entry) {
  const LaneMask fresh = states_[entry].fresh;
  for (const Link& link : index_->links_of(states_[entry].leaf)) {
    if ((link.boundary & fresh) == 0) continue;
    const Entry other = entry_of(link.leaf);
    push_words(index_->cross_edges_of(link), fresh_[entry], words_[other].pending);
    if (!states_[other].is_pending) {
      states_[other].is_pending = true;
      pending_.push_back(other);
    }
  }
}

/// Reaches what is pending, for the queries that have not ended.
void RingPacket::step(std::uint32_t ring, QueryWord alive) {
  active_.clear();
  for (const Entry entry : pending_) {
    State& state = states_[entry];
    state.is_pending = false;
    state.fresh = kernels_->step_words(words_[entry], fresh_[entry], &index_->adjacency[state.first], state.fresh,
                                       state.open, alive);
    if (state.fresh == 0) continue;
    state.is_reached = true;
    active_.push_back(entry);
    if (queries_ == 1) for_each_lane(state.fresh, [&](unsigned lane) { edges_[entry][lane] = ring; });
  }
}

/// Lists what was reached, without the ignored vertices.
void RingPacket::finish() {
  found_.clear();
  for (Entry entry = 0; entry < states_.size(); ++entry) {
    const LeafId leaf = states_[entry].leaf;
    if (!states_[entry].is_reached) continue;
    for_each_lane(index_->ignored_lanes(leaf), [&](unsigned lane) { words_[entry].reached[lane] = 0; });
    found_.push_back({entry, index_->leaf_begin[leaf]});
  }
}

PerLane<std::uint64_t> RingPacket::counts() const {
  PerLane<std::uint64_t> counts{};
  kernels_->count_words(words_.data(), found_, counts);
  return counts;
}

std::span<const Piece> RingPacket::pieces() {
  pieces_.clear();
  for (const LeafOfWords& found : found_) {
    const LeafId leaf = states_[found.words].leaf;
    pieces_.push_back({{leaf, leaf + 1}, 0, words_[found.words].reached.data()});
  }
  std::ranges::sort(pieces_, {}, [](const Piece& piece) { return piece.leaves.begin; });
  return pieces_;
}

}  // namespace meshhood::inline v0_1
