// SPDX-License-Identifier: MIT
#include "exact/query/ring_search.h"

#include <cassert>

namespace meshhood {

RingSearch::RingSearch(const IndexView& index, const Kernels& kernels)
    : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

void RingSearch::start(std::uint32_t slot) {
  next_leaves_.clear();
  ring_.clear();
  states_.forget();
  const LaneMask lane = LaneMask{1} << lane_of(slot);
  State& state = state_of(leaf_of(slot));
  if ((state.seen & lane) != 0) return;
  state.seen |= lane;
  ring_.push_back({leaf_of(slot), lane});
}

void RingSearch::advance() {
  for (const LeafSubset& subset : ring_) {
    LaneMask neighbors = 0;
    const std::size_t first = index_->leaf_begin[subset.leaf];
    for_each_lane(subset.lanes, [&](unsigned lane) { neighbors |= index_->adjacency[first + lane]; });
    add(subset.leaf, neighbors);
    for (const Link& link : index_->links_of(subset.leaf)) {
      if ((link.boundary & subset.lanes) == 0) continue;
      add(link.leaf, kernels_->cross_edges(index_->cross_edges_of(link), subset.lanes));
    }
  }
  ring_.clear();
  for (const LeafId leaf : next_leaves_) {
    State& state = states_[leaf];
    assert(state.next != 0 && (state.next & state.seen) == 0);  // a leaf is listed once, its vertices are new
    ring_.push_back({leaf, state.next});
    state.seen |= state.next;
    state.next = 0;
  }
  next_leaves_.clear();
}

RingSearch::State& RingSearch::state_of(LeafId leaf) {
  return states_.is_known(leaf) ? states_[leaf] : states_.set(leaf, {.seen = ~index_->open_lanes(leaf)});
}

/// Adds those of the vertices to the next ring that are in none yet.
void RingSearch::add(LeafId leaf, LaneMask lanes) {
  State& state = state_of(leaf);
  const LaneMask added = lanes & ~(state.seen | state.next);
  if (added == 0) return;
  if (state.next == 0) next_leaves_.push_back(leaf);
  state.next |= added;
}

}  // namespace meshhood
