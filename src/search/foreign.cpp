// SPDX-License-Identifier: MIT
#include "search/foreign.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace meshhood {

bool Foreign::find(std::uint32_t place, std::span<const LocalMinimum> minima, std::size_t budget, const LeafBall& ball,
                   const TreeBall& tree_ball, LeafWalk& walk) {
  found_.clear();
  ball_ = &ball;
  tree_ball_ = &tree_ball;
  budget_ = budget;
  walk.start(ball, tree_ball);
  start_walk(place / kLeafCapacity, Lanes{1} << place % kLeafCapacity, walk);
  reached_.push_back(place / kLeafCapacity);
  walk.reach(place / kLeafCapacity);
  settle(walk);
  for (const LocalMinimum& minimum : minima) {
    const Lanes lane = Lanes{1} << minimum.lane;
    if ((walk.touch(minimum.leaf).settled & lane) != 0) continue;
    start_walk(minimum.leaf, lane, walk);
    const End end = finish_walk(minimum.square, walk);
    if (end == End::OverBudget) return false;
    if (end == End::Exhausted) append_reached(walk);
    settle(walk);
  }
  put_in_order();
  return true;
}

void Foreign::start_walk(LeafId leaf, Lanes lane, LeafWalk& walk) {
  heap_.clear();
  reached_.clear();
  walk.touch(leaf).pending = lane;
  wait(leaf);
}

Foreign::End Foreign::finish_walk(double square, LeafWalk& walk) {
  while (!heap_.empty()) {
    if (budget_-- == 0) return End::OverBudget;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater());
    const LeafId leaf = heap_.back().second;
    heap_.pop_back();
    LeafWalk::State& state = walk.touch(leaf);
    const bool is_new = state.reached == 0;
    const Lanes added = walk.reach(leaf);
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

bool Foreign::has_nearer(LeafId leaf, Lanes lanes, double square) const {
  return kernels_->nearest(index_->positions, index_->leaves[leaf].first, lanes, *ball_).square < square;
}

/// The leaf waits, the nearer to the query vertex the shorter: downhill.
void Foreign::wait(LeafId leaf) {
  const FrameSphere& bounds = index_->leaves[leaf].bounds;
  const float x = bounds.x - tree_ball_->x;
  const float y = bounds.y - tree_ball_->y;
  const float z = bounds.z - tree_ball_->z;
  heap_.emplace_back((x * x + y * y) + z * z, leaf);
  std::push_heap(heap_.begin(), heap_.end(), std::greater());
}

/// Ends a walk: what it has reached, later ones that meet it need not walk through again.
void Foreign::settle(LeafWalk& walk) {
  for (const auto& [distance, leaf] : heap_) walk.touch(leaf).pending = 0;
  for (const LeafId leaf : reached_) {
    LeafWalk::State& state = walk.touch(leaf);
    state.settled |= state.reached;
    state.reached = 0;
  }
}

void Foreign::append_reached(LeafWalk& walk) {
  for (const LeafId leaf : reached_) found_.push_back({leaf, walk.touch(leaf).reached});
}

void Foreign::put_in_order() {
  std::sort(found_.begin(), found_.end(), [](const PartialLeaf& a, const PartialLeaf& b) { return a.leaf < b.leaf; });
  std::size_t kept = 0;
  for (const PartialLeaf& next : found_) {
    if (kept != 0 && found_[kept - 1].leaf == next.leaf) {
      found_[kept - 1].lanes |= next.lanes;
    } else {
      found_[kept++] = next;
    }
  }
  found_.resize(kept);
}

void Foreign::cut_from(Answer& answer) {
  if (found_.empty()) return;
  for (PartialLeaf& part : answer.parts) {
    const auto found = first_from(index_->leaf_begin[part.leaf]);
    if (found != found_.end() && found->leaf == part.leaf) part.lanes &= ~found->lanes;
  }
  std::erase_if(answer.parts, [](const PartialLeaf& part) { return part.lanes == 0; });
  runs_.clear();
  for (const VertexRange& run : answer.runs) append_what_is_left(run, answer.parts);
  std::swap(answer.runs, runs_);
}

/// A run is made of whole leaves.
void Foreign::append_what_is_left(const VertexRange& run, std::vector<PartialLeaf>& parts) {
  VertexId begin = run.begin;
  for (auto it = first_from(run.begin); it != found_.end() && index_->leaf_begin[it->leaf] < run.end; ++it) {
    const VertexId first = index_->leaf_begin[it->leaf];
    const VertexId end = index_->leaf_begin[it->leaf + 1];
    if (begin < first) runs_.push_back({begin, first});
    const Lanes left = first_lanes(end - first) & ~it->lanes;
    if (left != 0) parts.push_back({it->leaf, left});
    begin = end;
  }
  if (begin < run.end) runs_.push_back({begin, run.end});
}

/// The first of what has been found that does not begin before `vertex`.
std::vector<PartialLeaf>::const_iterator Foreign::first_from(VertexId vertex) const {
  return std::lower_bound(found_.begin(), found_.end(), vertex, [this](const PartialLeaf& part, VertexId bound) {
    return index_->leaf_begin[part.leaf] < bound;
  });
}

}  // namespace meshhood
