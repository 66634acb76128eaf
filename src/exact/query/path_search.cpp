// SPDX-License-Identifier: MIT
#include "exact/query/path_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/distance.h"

namespace meshhood {

PathSearch::PathSearch(const IndexView& index)
    : index_(&index), runs_(index.leaf_count()), lengths_(index.vertex_count()) {}

void PathSearch::run(std::uint32_t slot, double radius, const LaneFilter& walls) {
  walls_ = &walls;
  unreached_ = std::nextafter(radius, std::numeric_limits<double>::infinity());  // mutant: path-of-the-radius-refused
  queue_.clear();
  found_.clear();
  if (++run_ == 0) {
    std::fill(runs_.begin(), runs_.end(), 0);
    run_ = 1;
  }
  open(leaf_of(slot));
  offer({0, slot, index_->leaf_begin[leaf_of(slot)] + lane_of(slot)});
  std::visit([&](auto xyz) { run(xyz); }, index_->positions);
}

template <class Real>
void PathSearch::run(std::span<const Real> xyz) {
  while (!queue_.empty()) {
    const Found next = queue_.pop();
    if (next.length > lengths_[next.vertex]) continue;  // mutant: longer-path-settles-again
    found_.push_back(next);
    follow_edges(next, xyz);
  }
}

template <class Real>
void PathSearch::follow_edges(const Found& from, std::span<const Real> xyz) {
  const LeafId leaf = leaf_of(from.slot);
  const unsigned lane = lane_of(from.slot);
  const Point start = point(xyz, from.vertex);
  const auto follow = [&](LeafId other, std::uint32_t first, unsigned to) {
    if (lengths_[first + to] <= from.length) return;
    const double length = std::sqrt(squared_distance(start, point(xyz, first + to)));
    offer({from.length + length, kLeafCapacity * other + to, first + to});
  };
  for_each_lane(index_->adjacency[from.vertex], [&](unsigned to) { follow(leaf, from.vertex - lane, to); });
  for (const Link& link : index_->links_of(leaf)) {
    if ((link.boundary >> lane & 1U) == 0) continue;
    open(link.leaf);
    for (const CrossEdge& edge : index_->cross_edges_of(link)) {
      if (edge.from == lane) follow(link.leaf, index_->leaf_begin[link.leaf], edge.to);
    }
  }
}

/// Initializes the lengths of a leaf. That of a wall is 0, so that no path to it is shorter.
void PathSearch::open(LeafId leaf) {
  if (runs_[leaf] == run_) return;
  runs_[leaf] = run_;
  const std::size_t first = index_->leaf_begin[leaf];
  const std::span lengths = std::span(lengths_).subspan(first, index_->leaf_begin[leaf + 1] - first);
  std::fill(lengths.begin(), lengths.end(), unreached_);
  for_each_lane(walls_->of(leaf), [&](unsigned lane) { lengths[lane] = 0; });
}

void PathSearch::offer(const Found& path) {
  double& least = lengths_[path.vertex];
  if (!(path.length < least)) return;
  least = path.length;
  queue_.push(path);
}

}  // namespace meshhood
