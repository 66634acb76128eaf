// SPDX-License-Identifier: MIT
#include "exact/search/reach.h"

#include <algorithm>

#include "base/prefetch.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {

/// Begins with large nodes, which are few. Where they reach more than a single sheet, begins again with small ones,
/// which leave out what is not connected at that scale. Leaves save nothing over a search along their links.
bool Reach::run(const Query& query) {
  // How many mean radii of nodes the radius of the ball has at most.
  constexpr double kSmallNodes = 10;   // the paper's f
  constexpr double kLargeNodes = 2.5;  // chosen: larger ones hide which parts are connected within the ball
  const Home small = home_of(query, kSmallNodes);
  const Home large = home_of(query, kLargeNodes);
  const bool is_reached = large.level > small.level && reach_from(large, query, small.level);
  if (!is_reached) {
    if (small.level == 0) return false;
    static_cast<void>(reach_from(small, query, small.level));
  }
  find_surface_leaves(query);
  return true;
}

/// The node over the query vertex on the lowest level whose nodes have a mean radius of a `ratio`-th of the radius or
/// more.
Reach::Home Reach::home_of(const Query& query, double ratio) const {
  Home home{0, query.leaf()};
  for (; index_->tree[home.level].mean_radius * ratio < query.radius_in_frame; ++home.level) {
    const NodeId parent = index_->parents[home.node / kFanOut];
    if (parent == kNoNode) break;
    home.node = parent;
  }
  return home;
}

/// Returns false if more nodes intersect the surface of the ball, on a level above `limited_above`, than a single sheet
/// has.
bool Reach::reach_from(const Home& home, const Query& query, std::size_t limited_above) {
  states_.start(index_->tree[home.level].first_group + index_->tree[home.level].groups);
  waves_.run(home.node, query.tree_ball, states_);
  return descent_.run(home.level, waves_.groups(), query, limited_above, states_);
}

void Reach::find_surface_leaves(const Query& query) {
  constexpr std::size_t kLeavesAhead = 10;
  const std::span<const LeafId> leaves = descent_.surface_leaves();
  // From the records of groups, which the descent has just read.
  const auto vertices_of = [&](LeafId leaf) { return run_of(index_->records[leaf / kFanOut], leaf % kFanOut); };
  const auto prefetch_vertices = [&](LeafId leaf) {
    const VertexId first = vertices_of(leaf).begin;
    prefetch_positions(*index_, first, kLeafCapacity);
    fetch_lines(&index_->adjacency[first], 3);
    prefetch(&index_->leaves[leaf]);
  };
  for (const LeafId leaf : leaves.first(std::min(kLeavesAhead, leaves.size()))) prefetch_vertices(leaf);
  surface_leaves_.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kLeavesAhead < leaves.size()) prefetch_vertices(leaves[i + kLeavesAhead]);
    const auto [first, end] = vertices_of(leaves[i]);
    LaneMask lanes = kernels_->within(index_->positions, first, end - first, query.ball);
    if (!index_->walls.empty()) lanes &= ~index_->walls[leaves[i]];
    if (lanes == 0 || lanes == first_lanes(end - first)) {
      settle(leaves[i], lanes != 0);
      continue;
    }
    const std::size_t group = leaves[i] / kFanOut;
    if (surface_leaves_.empty() || surface_leaves_.back().leaf / kFanOut != group) {
      first_surface_leaf_[group] = static_cast<std::uint32_t>(surface_leaves_.size());
    }
    surface_leaves_.push_back({leaves[i], lanes});
    fetch_lines(&index_->links[index_->leaves[leaves[i]].first_link], 2);
  }
}

/// For a leaf that intersects the ball by its sphere, but whose vertices are all in the ball, or all outside.
void Reach::settle(LeafId leaf, bool is_whole) {
  GroupState& state = states_[leaf / kFanOut];
  const NodeSet bit = node_at(leaf % kFanOut);
  state.intersecting &= static_cast<NodeSet>(~bit);
  if (is_whole) state.whole |= bit;
}

std::size_t Reach::place_of(LeafId leaf) const {
  const std::uint32_t group = leaf / kFanOut;
  if (!states_.is_known(group)) return kNoPlace;
  const unsigned intersecting = states_[group].intersecting;
  if ((intersecting >> leaf % kFanOut & 1U) == 0) return kNoPlace;
  const unsigned before = intersecting & (node_at(leaf % kFanOut) - 1U);
  return std::size_t{first_surface_leaf_[group]} + count_of(before);
}

}  // namespace meshhood::inline v0_1
