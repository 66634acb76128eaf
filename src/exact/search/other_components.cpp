// SPDX-License-Identifier: MIT
#include "exact/search/other_components.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace meshhood {

bool OtherComponents::find(std::uint32_t slot, std::span<const LocalMinimum> minima, std::size_t budget,
                           const LeafBall& ball, const TreeBall& tree_ball, LeafTraversal& walk) {
  found_.clear();
  ball_ = &ball;
  tree_ball_ = &tree_ball;
  budget_ = budget;
  walk.start(ball, tree_ball);
  start_walk(leaf_of(slot), LaneMask{1} << lane_of(slot), walk);
  reached_.push_back(leaf_of(slot));
  walk.reach(leaf_of(slot));
  settle(walk);
  for (const LocalMinimum& minimum : minima) {
    const LaneMask lane = LaneMask{1} << minimum.lane;
    if ((walk.touch(minimum.leaf).settled & lane) != 0) continue;
    start_walk(minimum.leaf, lane, walk);
    const End end = finish_walk(minimum.square, walk);
    if (end == End::OverBudget) return false;
    if (end == End::Exhausted) append_reached(walk);  // mutant: other-components-kept
    settle(walk);
  }
  put_in_order();
  return true;
}

void OtherComponents::start_walk(LeafId leaf, LaneMask lane, LeafTraversal& walk) {
  heap_.clear();
  reached_.clear();
  walk.touch(leaf).pending = lane;
  wait(leaf);
}

OtherComponents::End OtherComponents::finish_walk(double square, LeafTraversal& walk) {
  while (!heap_.empty()) {
    if (budget_-- == 0) return End::OverBudget;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater());
    const LeafId leaf = heap_.back().second;
    heap_.pop_back();
    LeafTraversal::State& state = walk.touch(leaf);
    const bool is_new = state.reached == 0;
    const LaneMask added = walk.reach(leaf);
    if (added == 0) continue;
    if (is_new) reached_.push_back(leaf);
    if ((added & state.settled) != 0 || has_nearer(leaf, added, square)) return End::Met;
    waiting_.clear();
    walk.push_on(leaf, added, waiting_);
    for (const LeafId next : waiting_) wait(next);
    const auto is_met = [&](LeafId next) { return (walk.touch(next).pending & walk.touch(next).settled) != 0; };
    if (std::any_of(waiting_.begin(), waiting_.end(), is_met)) return End::Met;
  }
  return End::Exhausted;
}

bool OtherComponents::has_nearer(LeafId leaf, LaneMask lanes, double square) const {
  return kernels_->nearest(index_->positions, index_->leaves[leaf].first, lanes, *ball_).square < square;
}

/// The leaf waits, the nearer to the query vertex the shorter: downhill.
void OtherComponents::wait(LeafId leaf) {
  const FrameSphere& bounds = index_->leaves[leaf].bounds;
  const float x = bounds.x - tree_ball_->x;
  const float y = bounds.y - tree_ball_->y;
  const float z = bounds.z - tree_ball_->z;
  heap_.emplace_back((x * x + y * y) + z * z, leaf);
  std::push_heap(heap_.begin(), heap_.end(), std::greater());
}

/// Ends a walk: what it has reached, later ones that meet it need not walk through again.
void OtherComponents::settle(LeafTraversal& walk) {
  for (const auto& [distance, leaf] : heap_) walk.touch(leaf).pending = 0;
  for (const LeafId leaf : reached_) {
    LeafTraversal::State& state = walk.touch(leaf);
    state.settled |= state.reached;
    state.reached = 0;
  }
}

void OtherComponents::append_reached(LeafTraversal& walk) {
  for (const LeafId leaf : reached_) found_.push_back({leaf, walk.touch(leaf).reached});
}

void OtherComponents::put_in_order() {
  std::sort(found_.begin(), found_.end(), [](const LeafSubset& a, const LeafSubset& b) { return a.leaf < b.leaf; });
  std::size_t kept = 0;
  for (const LeafSubset& next : found_) {
    if (kept != 0 && found_[kept - 1].leaf == next.leaf) {
      found_[kept - 1].lanes |= next.lanes;
    } else {
      found_[kept++] = next;
    }
  }
  found_.resize(kept);
}

void OtherComponents::cut_from(VertexSet& answer) {
  if (found_.empty()) return;
  for (LeafSubset& subset : answer.subsets) {
    const auto found = first_from(index_->leaf_begin[subset.leaf]);
    if (found != found_.end() && found->leaf == subset.leaf) subset.lanes &= ~found->lanes;
  }
  std::erase_if(answer.subsets, [](const LeafSubset& subset) { return subset.lanes == 0; });
  runs_.clear();
  for (const VertexRange& run : answer.runs) append_what_is_left(run, answer.subsets);
  std::swap(answer.runs, runs_);
}

/// A run is made of whole leaves.
void OtherComponents::append_what_is_left(const VertexRange& run, std::vector<LeafSubset>& subsets) {
  VertexId begin = run.begin;
  for (auto it = first_from(run.begin); it != found_.end() && index_->leaf_begin[it->leaf] < run.end; ++it) {
    const VertexId first = index_->leaf_begin[it->leaf];
    const VertexId end = index_->leaf_begin[it->leaf + 1];
    if (begin < first) runs_.push_back({begin, first});
    const LaneMask left = first_lanes(end - first) & ~it->lanes;
    if (left != 0) subsets.push_back({it->leaf, left});  // mutant: rest-of-cut-leaf-dropped
    begin = end;
  }
  if (begin < run.end) runs_.push_back({begin, run.end});
}

/// The first of what has been found that does not begin before `vertex`.
std::vector<LeafSubset>::const_iterator OtherComponents::first_from(VertexId vertex) const {
  return std::lower_bound(found_.begin(), found_.end(), vertex, [this](const LeafSubset& subset, VertexId bound) {
    return index_->leaf_begin[subset.leaf] < bound;
  });
}

}  // namespace meshhood
