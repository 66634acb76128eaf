// SPDX-License-Identifier: MIT
#include "exact/query/flood.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/prefetch.h"

namespace meshhood::inline v0_1 {

Flood::Flood(const IndexView& index, const Kernels& kernels)
    : index_(&index),
      kernels_(&kernels),
      center_(index.frame, {0, 0, 0}),
      ball_(any_ball({0, 0, 0}, 0)),
      states_(index.leaf_count()) {}

void Flood::start(const Point& center) {
  center_ = Center(index_->frame, center);
  ball_ = any_ball(center, 0);
  ball_.squared_radius = -1;  // the ball is empty: it does not hold its center
  awake_.clear();
  sleepers_.clear();
  reached_.clear();
  states_.forget();
}

/// Returns the state of a leaf, which is initialized when a flood first needs it.
Flood::State& Flood::state_of(LeafId leaf) {
  if (states_.is_known(leaf)) return states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  return states_.set(leaf, {.open = index_->open_lanes(leaf),
                            .connected = record.connected,
                            .wakes = kInfinity,
                            .squares = squared_distances(record.bounds, center_)});
}

bool Flood::is_whole(const State& state) const { return state.connected && state.squares.high <= ball_.squared_radius; }

void Flood::add_seed(std::uint32_t slot) {
  State& state = state_of(leaf_of(slot));
  state.pending |= LaneMask{1} << lane_of(slot) & state.open;
  if (state.pending != 0) rest(leaf_of(slot), state, state.squares.low, false);
}

/// Wakes a leaf that has gained pending vertices, or lets it rest if all of it is outside the ball.
void Flood::wake_or_rest(LeafId leaf, State& state) {
  if (state.squares.low > ball_.squared_radius) {
    rest(leaf, state, state.squares.low, false);
  } else {
    wake(leaf, state);
  }
}

/// Puts the leaf into the work list, unless it is there.
void Flood::wake(LeafId leaf, State& state) {
  assert(&state == &states_[leaf]);  // the state must be known
  if (state.is_awake) return;
  state.is_awake = true;
  awake_.push_back(leaf);
  const Leaf& record = index_->leaves[leaf];
  fetch_lines(&index_->links[record.first_link], 2);
  fetch_lines(&index_->adjacency[record.first], 2);
  prefetch_positions(*index_, record.first, record.size);
}

/// Puts the leaf to sleep, unless it already sleeps with a bound that is no larger.
void Flood::rest(LeafId leaf, State& state, double bound, bool is_exact) {
  if (state.wakes <= bound) return;
  state.wakes = bound;
  state.is_exact = is_exact;
  sleepers_.add(leaf, bound);
}

void Flood::grow(double radius, std::uint32_t target) {
  ball_ = any_ball(center_.exact, radius);
  sleepers_.wake(ball_.squared_radius, [&](const Sleepers::Entry& entry) {
    State& state = states_[entry.leaf];
    if (state.wakes != entry.bound) return;  // outdated: the leaf has another entry with a smaller bound
    state.wakes = kInfinity;
    wake(entry.leaf, state);
  });
  constexpr std::size_t kVerticesAhead = 8;
  for (std::size_t head = 0; head < awake_.size(); ++head) {
    if (head + kVerticesAhead < awake_.size()) prefetch_neighbors(awake_[head + kVerticesAhead]);
    visit(awake_[head]);
    if (target != kNoTarget && has_reached(target)) return;
  }
  awake_.clear();
}

void Flood::prefetch_neighbors(LeafId leaf) const {
  for (const Link& link : index_->links_of(leaf)) {
    prefetch(states_.address(link.leaf));
    prefetch(&index_->leaves[link.leaf]);
  }
}

void Flood::visit(LeafId leaf) {
  State& state = states_[leaf];
  const Leaf& record = index_->leaves[leaf];
  state.is_awake = false;
  const LaneMask added = enter(state, record);
  if (added != 0) {
    reached_.push_back({leaf, added});
    expand(leaf, added);
  }
  // The bound is that of the ball, because all that is left is farther away.
  if (state.reached != state.open) rest(leaf, state, ball_.squared_radius, false);
}

/// Reaches what the ball now connects within the leaf. Returns the vertices added.
LaneMask Flood::enter(State& state, const Leaf& leaf) {
  const LaneMask from = state.reached | state.pending;
  LaneMask now = state.open;
  if (!is_whole(state)) {
    const LaneMask among = find_inside(state, leaf);
    if ((among & from) == 0) return 0;
    now = kernels_->reachable(&index_->adjacency[leaf.first], among, among & from);
  }
  const LaneMask added = now & ~state.reached;
  state.reached |= added;
  state.pending &= ~added;
  return added;
}

/// Returns the vertices of the leaf that are in the ball and no walls.
LaneMask Flood::find_inside(State& state, const Leaf& leaf) {
  if (state.inside_of != ball_.squared_radius) {
    state.inside = kernels_->within(index_->positions, leaf.first, leaf.size, ball_) & state.open;
    state.inside_of = ball_.squared_radius;
  }
  return state.inside;
}

/// Makes the vertices of other leaves pending that have a neighbor among those added to this one.
void Flood::expand(LeafId leaf, LaneMask added) {
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary & added) == 0) continue;
    State& other = state_of(link.leaf);
    const LaneMask open = other.open & ~(other.reached | other.pending);
    if (open == 0) continue;
    // In a leaf that the ball takes as a whole, each vertex leads to all others.
    const LaneMask met = is_whole(other) ? open : kernels_->cross_edges(index_->cross_edges_of(link), added) & open;
    if (met == 0) continue;
    other.pending |= met;
    wake_or_rest(link.leaf, other);
  }
}

/// Returns the vertices not yet reached that have a reached neighbor or are seeds.
LaneMask Flood::border(const State& state, const Leaf& leaf) const {
  LaneMask lanes = state.pending;
  for_each_lane(state.reached, [&](unsigned lane) { lanes |= index_->adjacency[leaf.first + lane]; });
  return lanes & state.open & ~state.reached;
}

double Flood::nearest_square(const Leaf& leaf, LaneMask lanes) const {
  return std::visit(
      [&](auto xyz) {
        double least = kInfinity;
        for_each_lane(lanes, [&](unsigned lane) {
          least = std::min(least, squared_distance(point(xyz, std::size_t{leaf.first} + lane), ball_.center));
        });
        return least;
      },
      index_->positions);
}

double Flood::next_radius() {
  while (!sleepers_.empty()) {
    const Sleepers::Entry entry = sleepers_.first();
    State& state = states_[entry.leaf];
    const bool is_current = state.wakes == entry.bound;
    if (is_current && state.is_exact) return std::sqrt(entry.bound);
    sleepers_.remove_first();
    if (!is_current) continue;
    state.wakes = kInfinity;
    const Leaf& record = index_->leaves[entry.leaf];
    const LaneMask lanes = border(state, record);
    if (lanes != 0) rest(entry.leaf, state, nearest_square(record, lanes), true);
  }
  return kInfinity;
}

bool Flood::has_reached(std::uint32_t slot) const {
  return states_.is_known(leaf_of(slot)) && (states_[leaf_of(slot)].reached >> lane_of(slot) & 1U) != 0;
}

}  // namespace meshhood::inline v0_1
