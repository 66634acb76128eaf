// SPDX-License-Identifier: MIT
#include "search/flood.h"

#include <algorithm>

#include "prefetch.h"

namespace meshhood {
namespace {

// How many leaves of the queue, the present one included, have their neighbours fetched.
constexpr std::size_t kAhead = 6;

}  // namespace

Flood::Flood(const IndexStorage& index, const Kernels& kernels)
    : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

void Flood::run(std::uint32_t place, const LeafBall& ball, const TreeBall& tree_ball, Answer& answer) {
  ball_ = &ball;
  tree_ball_ = &tree_ball;
  std::visit([&](const auto& positions) { run_on(positions.data(), place, answer); }, index_->positions);
}

template <class Real>
void Flood::run_on(const Real* positions, std::uint32_t place, Answer& answer) {
  start_query();
  const LeafId first = place / kLeafCapacity;
  touch(first).pending = Lanes{1} << place % kLeafCapacity;
  queue_.push_back(first);
  std::size_t fetched = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::size_t soon = std::min(head + kAhead, queue_.size());
    for (; fetched < soon; ++fetched) fetch_neighbors(queue_[fetched]);
    const LeafId leaf = queue_[head];
    State& state = states_[leaf];
    const bool is_new = state.reached == 0;
    const Lanes added = reach(positions, leaf, state);
    if (added == 0) continue;
    if (is_new) reached_.push_back(leaf);
    push_on(leaf, added);
  }
  append_to(answer);
}

void Flood::start_query() {
  queue_.clear();
  reached_.clear();
  if (query_ == kLastQuery) {
    std::fill(states_.begin(), states_.end(), State{});
    query_ = 0;
  }
  ++query_;
}

/// What `push_on` will look at.
void Flood::fetch_neighbors(LeafId leaf) const {
  const std::uint32_t end = index_->leaves[leaf + 1].first_link;
  prefetch(&index_->crossings[index_->links[index_->leaves[leaf].first_link].first_crossing]);
  for (std::uint32_t i = index_->leaves[leaf].first_link; i < end; ++i) {
    prefetch(&states_[index_->links[i].leaf]);
    prefetch(&index_->leaves[index_->links[i].leaf]);
  }
}

/// What `reach` will look at, and then the output.
void Flood::fetch_leaf(const Leaf& leaf, bool straddling) const {
  fetch_lines(&index_->links[leaf.first_link], 2);
  fetch_lines(&index_->permutation[leaf.first], 2);
  if (!straddling) return;
  fetch_lines(&index_->adjacency[leaf.first], 2);
  std::visit(
      [&](const auto& positions) {
        const auto* first = &positions[3 * std::size_t{leaf.first}];
        fetch_lines(first, 3 * leaf.size * sizeof(*first) / kCacheLine + 1);
      },
      index_->positions);
}

/// The state of a leaf, set up when the query first meets it.
Flood::State& Flood::touch(LeafId leaf) {
  State& state = states_[leaf];
  if (state.query == query_) return state;
  const Leaf& record = index_->leaves[leaf];
  const Placement side = place(record.bounds, *tree_ball_);
  const Lanes all = first_lanes(record.size);
  state = {query_ & kLastQuery, side == Placement::Inside && record.connected, side == Placement::Outside ? 0 : all, 0,
           0};
  if (side != Placement::Outside) fetch_leaf(record, side == Placement::Straddling);
  return state;
}

/// Takes what is pending and returns what the leaf has thereby reached.
template <class Real>
Lanes Flood::reach(const Real* positions, LeafId leaf, State& state) const {
  const Leaf& record = index_->leaves[leaf];
  if (!state.whole && state.reached == 0) {
    state.inside = kernels_->within(positions + 3 * std::size_t{record.first}, record.size, *ball_);
  }
  const Lanes open = state.inside & ~state.reached;
  const Lanes from = state.pending & open;
  state.pending = 0;
  if (from == 0) return 0;
  const Lanes added = state.whole ? open : kernels_->spread(&index_->adjacency[record.first], open, from);
  state.reached |= added;
  return added;
}

/// Makes pending what lies across the edges that leave `added`.
void Flood::push_on(LeafId leaf, Lanes added) {
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
    if (other.pending == 0) queue_.push_back(link.leaf);
    other.pending |= met;
  }
}

void Flood::append_to(Answer& answer) const {
  for (const LeafId leaf : reached_) {
    const Leaf& record = index_->leaves[leaf];
    const Lanes lanes = states_[leaf].reached;
    if (lanes == first_lanes(record.size)) {
      answer.runs.push_back({record.first, static_cast<VertexId>(record.first + record.size)});
    } else {
      answer.parts.push_back({leaf, lanes});
    }
  }
}

}  // namespace meshhood
