// SPDX-License-Identifier: MIT
#include "exact/query/path_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <variant>

#include "base/distance.h"
#include "base/prefetch.h"

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
  offer({0, slot}, radius);
  std::visit([&](auto xyz) { run(xyz, radius); }, index_->positions);
}

template <class Real>
void PathSearch::run(std::span<const Real> xyz, double radius) {
  while (!queue_.empty()) {
    const Found next = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    State& state = states_[leaf_of(next.slot)];
    const LaneMask lane = LaneMask{1} << lane_of(next.slot);
    if ((state.settled & lane) != 0) continue;  // mutant: longer-path-settles-again
    state.settled |= lane;
    found_.push_back(next);
    relax_neighbors(xyz, next, radius);
  }
}

/// Offers the paths that go on to the neighbours of a vertex.
template <class Real>
void PathSearch::relax_neighbors(std::span<const Real> xyz, const Found& from, double radius) {
  const LeafId leaf = leaf_of(from.slot);
  const unsigned lane = lane_of(from.slot);
  const std::size_t first = index_->leaf_begin[leaf];
  const Point start = point(xyz, first + lane);
  const auto relax = [&](LeafId other, std::size_t first_of_other, unsigned to) {
    const double length = std::sqrt(squared_distance(start, point(xyz, first_of_other + to)));
    offer({from.length + length, kLeafCapacity * other + to}, radius);
  };
  for_each_lane(index_->adjacency[first + lane], [&](unsigned to) { relax(leaf, first, to); });
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary >> lane & 1U) == 0) continue;
    const std::size_t first_of_other = index_->leaf_begin[link.leaf];
    for (const CrossEdge& edge : index_->cross_edges_of(link)) {
      if (edge.from == lane) relax(link.leaf, first_of_other, edge.to);
    }
  }
}

PathSearch::State& PathSearch::state_of(LeafId leaf) {
  State& state = states_[leaf];
  if (state.number == number_) return state;
  state = {number_, walls_->of(leaf)};
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
