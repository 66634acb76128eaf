// SPDX-License-Identifier: MIT
#include "exact/search/leaf_bfs.h"

#include <algorithm>

#include "base/prefetch.h"

namespace meshhood::inline v0_1 {

bool LeafBfs::run_within(std::size_t visits, const Query& query, VertexSet& answer) {
  query_ = &query;
  states_.forget();
  reached_.clear();  // a search that did not end has left some leaves
  queue_.clear();
  prefetched_ = 0;
  state_of(query.leaf()).pending = query.lane();
  queue_.push_back(query.leaf());
  for (head_ = 0; head_ < queue_.size(); ++head_) {
    if (head_ == visits) return false;
    prefetch_ahead();
    const LaneMask added = visit(queue_[head_]);
    if (added != 0) expand(queue_[head_], added);
  }
  reached_.take_all([&](std::size_t leaf) { answer.add_lanes({static_cast<LeafId>(leaf), states_[leaf].reached}); });
  return true;
}

/// Reaches what is pending in the leaf and what is connected to it there. Returns the vertices added.
LaneMask LeafBfs::visit(LeafId leaf) {
  State& state = states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  if (!state.is_whole && !state.is_visited) {
    state.open =
        kernels_->within(index_->positions, record.first, record.size, query_->ball) & index_->open_lanes(leaf);
  }
  state.is_visited = true;
  const LaneMask from = state.pending & state.open;
  state.pending = 0;
  if (from == 0) return 0;
  const LaneMask added =
      state.is_whole ? state.open : kernels_->reachable(&index_->adjacency[record.first], state.open, from);
  reached_.insert(leaf);
  state.reached |= added;
  state.open &= ~added;
  return added;
}

/// Makes the vertices pending that edges from the vertices `added` of the leaf lead to.
void LeafBfs::expand(LeafId leaf, LaneMask added) {
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & added) == 0) continue;
    State& other = state_of(link.leaf);
    const LaneMask open = other.open & ~other.pending;
    if (open == 0) continue;
    const LaneMask met = other.is_whole ? open : kernels_->cross_edges(index_->cross_edges_of(link), added) & open;
    if (met == 0) continue;
    if (other.pending == 0) queue_.push_back(link.leaf);
    other.pending |= met;
  }
}

/// Returns the state of a leaf, which is made when a query first needs it.
LeafBfs::State& LeafBfs::state_of(LeafId leaf) {
  if (states_.is_known(leaf)) return states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  const Containment side = classify(record.bounds, query_->tree_ball);
  if (side != Containment::Outside) prefetch_leaf(record, side == Containment::Intersecting);
  return states_.set(leaf, {.open = side == Containment::Outside ? 0 : first_lanes(record.size),
                            .is_whole = side == Containment::Inside && record.connected});
}

/// Prefetches what the next visits read of the neighbors of their leaves, and their first cross edges.
void LeafBfs::prefetch_ahead() {
  constexpr std::size_t kLeavesAhead = 12;    // the present one included
  constexpr std::size_t kCrossEdgeLines = 3;  // each has 32 edges
  const std::size_t soon = std::min(head_ + kLeavesAhead, queue_.size());
  for (; prefetched_ < soon; ++prefetched_) {
    const std::span<const Link> links = index_->links_of(queue_[prefetched_]);
    for (const Link& link : links) {
      prefetch(states_.address(link.leaf));
      prefetch(&index_->leaves[link.leaf]);
    }
    fetch_lines(&index_->cross_edges[links.data()->first_cross_edge], kCrossEdgeLines);
  }
}

void LeafBfs::prefetch_leaf(const Leaf& leaf, bool is_intersecting) const {
  fetch_lines(&index_->links[leaf.first_link], 2);
  if (!index_->permutation.empty()) fetch_lines(&index_->permutation[leaf.first], 2);
  if (!is_intersecting) return;
  fetch_lines(&index_->adjacency[leaf.first], 2);
  prefetch_positions(*index_, leaf.first, leaf.size);
}

}  // namespace meshhood::inline v0_1
