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

/// More intersecting nodes than a sheet of surface has where a ball of this size cuts it, with room for a curved one.
///
/// On a plane, nodes that are squares with a half diagonal of m have an area of 2 m^2, and those straddle whose centres
/// lie within m of the circle that the ball cuts out: 4 pi r m / 2 m^2 = 6.3 r / m of them (a smooth scan has 5.6, see
/// docs/engine.md). The factor is chosen, not derived: a little more than two such sheets have. So is the 12, for balls
/// no larger than a node, of which this says nothing: a group of eight, and half of another.
std::size_t most_intersecting(double ball_radius, double mean_radius) {
  return 12 + static_cast<std::size_t>(std::min(14 * ball_radius / mean_radius, 1e9));
}

}  // namespace

void NodeQueue::make_room(std::size_t groups) {
  const std::size_t needed = size_ + (groups + 1) * kFanOut;
  if (nodes_.size() < needed) nodes_.resize(2 * needed);
}

void NodeQueue::append(std::uint32_t group, std::uint8_t set) {
  // All eight are written, and those not in the set overwritten by what comes next: no jump to be foretold.
  std::uint32_t* out = nodes_.data() + size_;
  for (std::size_t i = 0; i < kFanOut; ++i) out[i] = group * kFanOut + kBitPositions[set][i];
  size_ += static_cast<std::size_t>(std::popcount(set));
}

bool Descent::run(const TreeBall& ball, std::vector<VertexRange>& runs) {
  intersecting_.clear();
  candidates_.clear();
  intersecting_.make_room(1);
  intersecting_.append(0, 1);  // the one group of the last level
  for (std::size_t level = index_->tree.size(); level-- > 0;) {
    refine_candidates(level, ball);
    refine_intersecting(level, ball);
    append_inside(level, runs);
    const double mean_radius = index_->tree[level].mean_radius;
    if (intersecting_.size() > most_intersecting(static_cast<double>(ball.outer), mean_radius)) return false;
  }
  return true;
}

void Descent::classify_groups(std::size_t level, std::span<const std::uint32_t> groups, const TreeBall& ball) {
  if (containments_.size() < groups.size()) containments_.resize(2 * groups.size());
  kernels_->classify(index_->tree[level].groups.data(), groups, ball, containments_.data());
}

/// From the may_have_minimum nodes of the level above to their may_have_minimum children: all are inside.
void Descent::refine_candidates(std::size_t level, const TreeBall& ball) {
  std::swap(groups_, candidates_);
  candidates_.clear();
  candidates_.make_room(groups_.size());
  classify_groups(level, groups_.nodes(), ball);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const std::uint32_t group = groups_.nodes()[i];
    candidates_.append(group, containments_[i].may_have_minimum & existing(index_->tree[level], group));
  }
}

/// From the intersecting nodes of the level above to their children.
void Descent::refine_intersecting(std::size_t level, const TreeBall& ball) {
  std::swap(groups_, intersecting_);
  intersecting_.clear();
  inside_.clear();
  intersecting_.make_room(groups_.size());
  inside_.make_room(groups_.size());
  candidates_.make_room(groups_.size());
  classify_groups(level, groups_.nodes(), ball);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const std::uint32_t group = groups_.nodes()[i];
    const GroupContainment& found = containments_[i];
    const std::uint8_t exist = existing(index_->tree[level], group);
    const std::uint8_t known = level == 0 ? found.inside | found.intersecting : found.inside;
    intersecting_.append(group, found.intersecting & exist);
    inside_.append(group, found.inside & exist);
    candidates_.append(group, found.may_have_minimum & known & exist);  // mutant: candidates-only-inside
  }
}

void Descent::append_inside(std::size_t level, std::vector<VertexRange>& runs) const {
  const std::size_t leaves = index_->leaf_count();
  for (const std::uint32_t node : inside_.nodes()) {
    const std::size_t first = std::size_t{node} << 3 * level;
    const std::size_t last = std::min(std::size_t{node + 1} << 3 * level, leaves);  // mutant: run-of-one-leaf
    runs.push_back({index_->leaf_begin[first], index_->leaf_begin[last]});
  }
}

}  // namespace meshhood
