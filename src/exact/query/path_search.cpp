// SPDX-License-Identifier: MIT
#include "exact/query/path_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <variant>

#include "base/distance.h"

namespace meshhood {

PathSearch::PathSearch(const IndexView& index)
    : index_(&index), states_(index.leaf_count()), lengths_(index.vertex_count()) {}

void PathSearch::run(std::uint32_t slot, double radius, const LaneFilter& walls) {
  walls_ = &walls;
  queue_.clear();
  found_.clear();
  if (++number_ == 0) {
    std::fill(states_.begin(), states_.end(), State{});
    number_ = 1;
  }
  rows_.clear();
  arcs_.clear();
  offer({0, slot}, radius);
  while (!queue_.empty()) {
    const Found next = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    State& state = states_[leaf_of(next.slot)];
    const LaneMask lane = LaneMask{1} << lane_of(next.slot);
    if ((state.settled & lane) != 0) continue;  // mutant: longer-path-settles-again
    state.settled |= lane;
    found_.push_back(next);
    for (const Arc& arc : arcs_of(next.slot)) offer({next.length + arc.length, arc.to}, radius);
  }
}

/// The edges of a vertex. Valid until the next call.
std::span<const PathSearch::Arc> PathSearch::arcs_of(std::uint32_t slot) {
  const LeafId leaf = leaf_of(slot);
  State& state = states_[leaf];
  if (!state.has_arcs) {
    state.first_row = rows_.size();
    const RowBegins begins = row_begins(leaf);
    rows_.insert(rows_.end(), begins.begin(), begins.end());
    std::visit([&](auto xyz) { add_arcs(xyz, leaf, begins); }, index_->positions);
    state.has_arcs = true;
  }
  const std::size_t* const row = &rows_[state.first_row + lane_of(slot)];
  return std::span(arcs_).subspan(row[0], row[1] - row[0]);
}

/// Where the arcs of each lane of a leaf begin in `arcs_`, if they are appended.
PathSearch::RowBegins PathSearch::row_begins(LeafId leaf) const {
  RowBegins begins{};
  const Leaf& record = index_->leaves[leaf];
  for (unsigned lane = 0; lane < record.size; ++lane) {
    begins[lane + 1] = static_cast<std::size_t>(std::popcount(index_->adjacency[record.first + lane]));
  }
  for (const Link& link : index_->links_of(leaf)) {
    for (const CrossEdge& edge : index_->cross_edges_of(link)) ++begins[edge.from + 1U];
  }
  begins[0] = arcs_.size();
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  return begins;
}

/// Appends the arcs of a leaf. `ends` are the begins of its rows, which move to their ends.
template <class Real>
void PathSearch::add_arcs(std::span<const Real> xyz, LeafId leaf, RowBegins ends) {
  arcs_.resize(ends.back());
  const auto add = [&](unsigned lane, LeafId other, unsigned to) {
    const Point a = point(xyz, std::size_t{index_->leaf_begin[leaf]} + lane);
    const Point b = point(xyz, std::size_t{index_->leaf_begin[other]} + to);
    arcs_[ends[lane]++] = {std::sqrt(squared_distance(a, b)), kLeafCapacity * other + to};
  };
  const Leaf& record = index_->leaves[leaf];
  for (unsigned lane = 0; lane < record.size; ++lane) {
    for_each_lane(index_->adjacency[record.first + lane], [&](unsigned to) { add(lane, leaf, to); });
  }
  for (const Link& link : index_->links_of(leaf)) {
    for (const CrossEdge& edge : index_->cross_edges_of(link)) add(edge.from, link.leaf, edge.to);
  }
}

PathSearch::State& PathSearch::state_of(LeafId leaf) {
  State& state = states_[leaf];
  if (state.number == number_) return state;
  state = {.number = number_, .settled = walls_->of(leaf)};
  const auto lengths = lengths_.begin();
  std::fill(lengths + static_cast<std::ptrdiff_t>(index_->leaf_begin[leaf]),
            lengths + static_cast<std::ptrdiff_t>(index_->leaf_begin[leaf + 1]),
            std::numeric_limits<double>::infinity());
  return state;
}

void PathSearch::offer(const Found& path, double radius) {
  if (path.length > radius) return;  // mutant: path-of-the-radius-refused
  const LeafId leaf = leaf_of(path.slot);
  const unsigned lane = lane_of(path.slot);
  if ((state_of(leaf).settled >> lane & 1U) != 0) return;
  double& least = lengths_[index_->leaf_begin[leaf] + lane];
  if (!(path.length < least)) return;
  least = path.length;
  queue_.push_back(path);
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

}  // namespace meshhood
