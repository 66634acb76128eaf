// SPDX-License-Identifier: MIT
#include "exact/search/leaf_traversal.h"

#include <algorithm>

#include "base/prefetch.h"

namespace meshhood {

LeafTraversal::LeafTraversal(const IndexView& index, const Kernels& kernels)
    : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

void LeafTraversal::start(const Query& query) {
  query_ = &query;
  if (query_number_ == kLastQueryNumber) {  // mutant: query-counter-never-wraps
    std::fill(states_.begin(), states_.end(), State{});
    query_number_ = 0;
  }
  ++query_number_;
}

/// The state of a leaf, which is initialised when a query first needs it.
LeafTraversal::State& LeafTraversal::state_of(LeafId leaf) {
  State& state = states_[leaf];
  if (state.query_number == query_number_) return state;
  const Leaf& record = index_->leaves[leaf];
  const Containment side = classify(record.bounds, query_->tree_ball);
  const LaneMask all = first_lanes(record.size);
  state = {.query_number = query_number_ & kLastQueryNumber,
           .whole = side == Containment::Inside && record.connected,  // mutant: disconnected-leaf-taken-whole
           .inside = side == Containment::Outside ? 0 : all,          // mutant: inside-leaf-taken-as-outside
           .reached = 0,
           .pending = 0,
           .settled = 0};
  if (side != Containment::Outside) prefetch_leaf(record, side == Containment::Intersecting);
  return state;
}

/// Reaches what is pending in the leaf and what is connected to it there. Returns the vertices added.
LaneMask LeafTraversal::visit(LeafId leaf) {
  State& state = states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  const bool is_first_visit = state.reached == 0 && state.settled == 0;
  if (!state.whole && is_first_visit) {
    state.inside = kernels_->within(index_->positions, record.first, record.size, query_->ball);
  }
  const LaneMask open = state.inside & ~state.reached;
  const LaneMask from = state.pending & open;
  state.pending = 0;
  if (from == 0) return 0;
  const LaneMask added = state.whole ? open : kernels_->reachable(&index_->adjacency[record.first], open, from);
  if (state.reached == 0) reached_leaves_.push_back(leaf);  // mutant: leaf-reached-twice
  state.reached |= added;
  return added;
}

/// Makes the vertices pending that edges from the vertices `added` of the leaf lead to. Returns whether one of them is
/// settled.
bool LeafTraversal::expand(LeafId leaf, LaneMask added) {
  LaneMask settled = 0;
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & added) == 0) continue;  // mutant: link-needs-whole-boundary
    State& other = state_of(link.leaf);
    const LaneMask open = other.inside & ~(other.reached | other.pending);
    if (open == 0) continue;
    // mutant: link-reaches-every-lane
    const LaneMask met = other.whole ? open : kernels_->cross_edges(index_->cross_edges_of(link), added) & open;
    if (met == 0) continue;
    if (other.pending == 0) newly_pending_.push_back(link.leaf);
    other.pending |= met;
    settled |= met & other.settled;
  }
  return settled != 0;
}

void LeafTraversal::settle() {
  for (const LeafId leaf : reached_leaves_) {
    State& state = states_[leaf];
    state.settled |= state.reached;
    state.reached = 0;
  }
}

void LeafTraversal::prefetch_leaf(const Leaf& leaf, bool intersecting) const {
  fetch_lines(&index_->links[leaf.first_link], 2);
  if (!index_->permutation.empty()) fetch_lines(&index_->permutation[leaf.first], 2);
  if (!intersecting) return;
  fetch_lines(&index_->adjacency[leaf.first], 2);
  prefetch_positions(*index_, leaf.first, leaf.size);
}

void LeafTraversal::prefetch_neighbors(LeafId leaf) const {
  for (const Link& link : index_->links_of(leaf)) {
    prefetch(&states_[link.leaf]);
    prefetch(&index_->leaves[link.leaf]);
  }
}

void LeafTraversal::prefetch_cross_edges(LeafId leaf) const {
  constexpr std::size_t kLines = 3;  // of 32 edges each
  fetch_lines(&index_->cross_edges[index_->links[index_->leaves[leaf].first_link].first_cross_edge], kLines);
}

}  // namespace meshhood
