// SPDX-License-Identifier: MIT
#include "exact/search/descent.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace meshhood {
namespace {

/// The nodes of `group` that exist.
std::uint8_t existing(const TreeLevel& level, std::uint32_t group) {
  const std::size_t left = level.nodes - std::size_t{group} * kFanOut;
  return static_cast<std::uint8_t>(left >= kFanOut ? 0xFFU : (1U << left) - 1);
}

}  // namespace

void NodeQueue::make_room(std::size_t groups) {
  const std::size_t needed = size_ + (groups + 1) * kFanOut;
  if (nodes_.size() < needed) nodes_.resize(2 * needed);
}

void NodeQueue::append(std::uint32_t group, std::uint8_t set) {
  // Writes eight nodes, and counts those in the set: faster than branching for each.
  std::uint32_t* out = nodes_.data() + size_;
  for (std::size_t i = 0; i < kFanOut; ++i) out[i] = group * kFanOut + kBitPositions[set][i];
  size_ += static_cast<std::size_t>(std::popcount(set));
}

bool Descent::run(const Query& query, const SearchLimits& limits, VertexSet& inside) {
  start();
  for (std::size_t level = index_->tree.size(); level-- > 0;) {
    refine_candidates(level, query.tree_ball);
    refine_intersecting(level, query.tree_ball);
    add_inside(level, inside);
    const double mean_radius = index_->tree[level].mean_radius;
    if (intersecting_.size() > limits.most_intersecting(query.radius_in_frame, mean_radius)) return false;
  }
  return true;
}

/// The last level has one group: the children of one root, which counts as intersecting.
void Descent::start() {
  intersecting_.clear();
  candidates_.clear();
  intersecting_.make_room(1);
  intersecting_.append(0, 1);
}

void Descent::classify_groups(std::size_t level, const TreeBall& ball) {
  if (containments_.size() < groups_.size()) containments_.resize(2 * groups_.size());
  kernels_->classify(index_->tree[level].groups.data(), groups_.nodes(), ball, containments_.data());
}

/// Replaces the candidates of the level above, which all lie inside, by their children that are candidates.
void Descent::refine_candidates(std::size_t level, const TreeBall& ball) {
  std::swap(groups_, candidates_);
  candidates_.clear();
  candidates_.make_room(groups_.size());
  classify_groups(level, ball);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const std::uint32_t group = groups_.nodes()[i];
    candidates_.append(group, containments_[i].may_have_minimum & existing(index_->tree[level], group));
  }
}

/// Replaces the intersecting nodes of the level above by their children, each according to its containment.
void Descent::refine_intersecting(std::size_t level, const TreeBall& ball) {
  std::swap(groups_, intersecting_);
  intersecting_.clear();
  inside_.clear();
  intersecting_.make_room(groups_.size());
  inside_.make_room(groups_.size());
  candidates_.make_room(groups_.size());
  classify_groups(level, ball);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const std::uint32_t group = groups_.nodes()[i];
    const GroupContainment& found = containments_[i];
    const std::uint8_t exist = existing(index_->tree[level], group);
    const std::uint8_t in_ball = level == 0 ? found.inside | found.intersecting : found.inside;
    intersecting_.append(group, found.intersecting & exist);
    inside_.append(group, found.inside & exist);
    candidates_.append(group, found.may_have_minimum & in_ball & exist);  // mutant: candidates-only-inside
  }
}

void Descent::add_inside(std::size_t level, VertexSet& set) const {
  const std::size_t leaves = index_->leaf_count();
  for (const std::uint32_t node : inside_.nodes()) {
    const std::size_t first = std::size_t{node} << 3 * level;
    const std::size_t last = std::min(std::size_t{node + 1} << 3 * level, leaves);  // mutant: run-of-one-leaf
    set.add(VertexRange{index_->leaf_begin[first], index_->leaf_begin[last]});
  }
}

}  // namespace meshhood
