// SPDX-License-Identifier: MIT
#include "search/leaf_walk.h"

#include <algorithm>

#include "prefetch.h"
#include "search/fetch.h"

namespace meshhood {

LeafWalk::LeafWalk(const IndexStorage& index, const Kernels& kernels)
    : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

void LeafWalk::start(const LeafBall& ball, const TreeBall& tree_ball) {
  ball_ = &ball;
  tree_ball_ = &tree_ball;
  if (query_ == kLastQuery) {
    std::fill(states_.begin(), states_.end(), State{});
    query_ = 0;
  }
  ++query_;
}

LeafWalk::State& LeafWalk::touch(LeafId leaf) {
  State& state = states_[leaf];
  if (state.query == query_) return state;
  const Leaf& record = index_->leaves[leaf];
  const Placement side = place(record.bounds, *tree_ball_);
  const Lanes all = first_lanes(record.size);
  state = {.query = query_ & kLastQuery,
           .whole = side == Placement::Inside && record.connected,
           .inside = side == Placement::Outside ? 0 : all,
           .reached = 0,
           .pending = 0,
           .settled = 0};
  if (side != Placement::Outside) fetch_leaf(record, side == Placement::Straddling);
  return state;
}

void LeafWalk::fetch_leaf(const Leaf& leaf, bool straddling) const {
  fetch_lines(&index_->links[leaf.first_link], 2);
  if (!index_->permutation.empty()) fetch_lines(&index_->permutation[leaf.first], 2);
  if (!straddling) return;
  fetch_lines(&index_->adjacency[leaf.first], 2);
  fetch_positions(*index_, leaf.first, leaf.size);
}

Lanes LeafWalk::reach(LeafId leaf) {
  State& state = states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  if (!state.whole && state.reached == 0 && state.settled == 0) {
    state.inside = kernels_->within(index_->positions, record.first, record.size, *ball_);
  }
  const Lanes open = state.inside & ~state.reached;
  const Lanes from = state.pending & open;
  state.pending = 0;
  if (from == 0) return 0;
  const Lanes added = state.whole ? open : kernels_->spread(&index_->adjacency[record.first], open, from);
  state.reached |= added;
  return added;
}

void LeafWalk::push_on(LeafId leaf, Lanes added, std::vector<LeafId>& waiting) {
  const std::uint32_t end = index_->leaves[leaf + 1].first_link;
  for (std::uint32_t i = index_->leaves[leaf].first_link; i < end; ++i) {
    const Link& link = index_->links[i];
    if ((link.border & added) == 0) continue;
    State& other = touch(link.leaf);
    const Lanes open = other.inside & ~(other.reached | other.pending);
    if (open == 0) continue;
    const std::uint32_t crossings = index_->links[i + 1].first_crossing - link.first_crossing;
    const Lanes met =
        other.whole ? open : kernels_->cross(&index_->crossings[link.first_crossing], crossings, added) & open;
    if (met == 0) continue;
    if (other.pending == 0) waiting.push_back(link.leaf);
    other.pending |= met;
  }
}

void LeafWalk::fetch_neighbors(LeafId leaf) const {
  const std::uint32_t end = index_->leaves[leaf + 1].first_link;
  for (std::uint32_t i = index_->leaves[leaf].first_link; i < end; ++i) {
    prefetch(&states_[index_->links[i].leaf]);
    prefetch(&index_->leaves[index_->links[i].leaf]);
  }
}

void LeafWalk::fetch_crossings(LeafId leaf) const {
  constexpr std::size_t kLines = 3;  // of 32 edges each
  fetch_lines(&index_->crossings[index_->links[index_->leaves[leaf].first_link].first_crossing], kLines);
}

}  // namespace meshhood
