// SPDX-License-Identifier: MIT
#include "exact/search/descent.h"

#include <algorithm>

#include "base/prefetch.h"

namespace meshhood::inline v0_1 {
namespace {

/// The most nodes of a level that may intersect the surface of the ball: more than one sheet of mesh has.
///
/// On a plane, nodes that are squares with a half diagonal of m have an area of 2 m^2. The nodes that intersect have
/// their centers within m of a circle of radius r, so there are about 4 pi r m / 2 m^2 = 6.3 r / m of them; on a
/// smooth scan, 5.6 were measured. 14 is chosen: a little more than two such sheets. So is 12, for balls no larger
/// than a node: a group and a half.
std::size_t most_intersecting(double radius_in_frame, double mean_radius) {
  return 12 + static_cast<std::size_t>(std::min(14 * radius_in_frame / mean_radius, 1e9));
}

}  // namespace

bool Descent::run(std::size_t level, std::span<const std::uint32_t> groups, const Query& query,
                  std::size_t limited_above, GroupStates& states) {
  groups_.assign(groups.begin(), groups.end());
  std::sort(groups_.begin(), groups_.end());
  intersecting_.clear();
  for (const std::uint32_t group : groups_) append(group, states[group].intersecting);
  for (;; --level) {
    if (level > limited_above &&
        intersecting_.size() > most_intersecting(query.radius_in_frame, index_->tree[level].mean_radius))
      return false;
    if (level == 0) return true;
    const std::size_t first = groups_.size();
    add_children();
    place(first, query.tree_ball, states);
  }
}

void Descent::append(std::uint32_t group, NodeSet intersecting) {
  // Writes eight nodes, and keeps those in the set: faster than branching for each.
  const std::size_t size = intersecting_.size();
  intersecting_.resize(size + kFanOut);
  for (std::size_t i = 0; i < kFanOut; ++i) intersecting_[size + i] = group * kFanOut + kBitPositions[intersecting][i];
  intersecting_.resize(size + count_of(intersecting));
}

/// Appends the groups that the intersecting nodes cover.
void Descent::add_children() {
  for (const NodeId node : intersecting_) {
    const std::uint32_t child = index_->records[node / kFanOut].first_child + node % kFanOut;
    groups_.push_back(child);
    fetch_lines(&index_->groups[child], sizeof(Group) / kCacheLine);
    prefetch(&index_->records[child]);
  }
}

/// Compares the groups from `first` on with the ball; their intersecting nodes are the new ones.
void Descent::place(std::size_t first, const TreeBall& ball, GroupStates& states) {
  const auto below = std::span(groups_).subspan(first);
  if (containments_.size() < below.size()) containments_.resize(2 * below.size());
  kernels_->classify(index_->groups.data(), below, ball, containments_.data());
  intersecting_.clear();
  for (std::size_t i = 0; i < below.size(); ++i) {
    GroupState& state = states.set(below[i], {});
    state.place(index_->records[below[i]], containments_[i]);
    append(below[i], state.intersecting);
  }
}

}  // namespace meshhood::inline v0_1
