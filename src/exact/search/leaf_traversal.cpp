// SPDX-License-Identifier: MIT
#include "exact/search/leaf_traversal.h"

#include <algorithm>

#include "base/prefetch.h"
#include "exact/search/fetch.h"

namespace meshhood {

LeafTraversal::LeafTraversal(const IndexView& index, const Kernels& kernels)
    : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

void LeafTraversal::start(const LeafBall& ball, const TreeBall& tree_ball) {
  ball_ = &ball;
  tree_ball_ = &tree_ball;
  if (query_ == kLastQuery) {  // mutant: query-counter-never-wraps
    std::fill(states_.begin(), states_.end(), State{});
    query_ = 0;
  }
  ++query_;
}

LeafTraversal::State& LeafTraversal::touch(LeafId leaf) {
  State& state = states_[leaf];
  if (state.query == query_) return state;
  const Leaf& record = index_->leaves[leaf];
  const Containment side = classify(record.bounds, *tree_ball_);
  const LaneMask all = first_lanes(record.size);
  state = {.query = query_ & kLastQuery,
           .whole = side == Containment::Inside && record.connected,  // mutant: disconnected-leaf-taken-whole
           .inside = side == Containment::Outside ? 0 : all,          // mutant: inside-leaf-taken-as-outside
           .reached = 0,
           .pending = 0,
           .settled = 0};
  if (side != Containment::Outside) fetch_leaf(record, side == Containment::Intersecting);
  return state;
}

void LeafTraversal::fetch_leaf(const Leaf& leaf, bool intersecting) const {
  fetch_lines(&index_->links[leaf.first_link], 2);
  if (!index_->permutation.empty()) fetch_lines(&index_->permutation[leaf.first], 2);
  if (!intersecting) return;
  fetch_lines(&index_->adjacency[leaf.first], 2);
  fetch_positions(*index_, leaf.first, leaf.size);
}

LaneMask LeafTraversal::reach(LeafId leaf) {
  State& state = states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  if (!state.whole && state.reached == 0 && state.settled == 0) {
    state.inside = kernels_->within(index_->positions, record.first, record.size, *ball_);
  }
  const LaneMask open = state.inside & ~state.reached;
  const LaneMask from = state.pending & open;
  state.pending = 0;
  if (from == 0) return 0;
  const LaneMask added = state.whole ? open : kernels_->reachable(&index_->adjacency[record.first], open, from);
  state.reached |= added;
  return added;
}

void LeafTraversal::push_on(LeafId leaf, LaneMask added, std::vector<LeafId>& waiting) {
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & added) == 0) continue;  // mutant: link-needs-whole-boundary
    State& other = touch(link.leaf);
    const LaneMask open = other.inside & ~(other.reached | other.pending);
    if (open == 0) continue;
    // mutant: link-reaches-every-lane
    const LaneMask met = other.whole ? open : kernels_->cross_edges(index_->cross_edges_of(link), added) & open;
    if (met == 0) continue;
    if (other.pending == 0) waiting.push_back(link.leaf);
    other.pending |= met;
  }
}

void LeafTraversal::fetch_neighbors(LeafId leaf) const {
  for (const Link& link : index_->links_of(leaf)) {
    prefetch(&states_[link.leaf]);
    prefetch(&index_->leaves[link.leaf]);
  }
}

void LeafTraversal::fetch_cross_edges(LeafId leaf) const {
  constexpr std::size_t kLines = 3;  // of 32 edges each
  fetch_lines(&index_->cross_edges[index_->links[index_->leaves[leaf].first_link].first_cross_edge], kLines);
}

}  // namespace meshhood
