// SPDX-License-Identifier: MIT
#include "exact/search/reach.h"

#include <algorithm>
#include <utility>

#include "base/prefetch.h"
#include "exact/node_search.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns how many nodes of a level may intersect the surface of the ball: more than one sheet of mesh has.
///
/// On a plane, square nodes with a half diagonal of m have an area of 2 m^2. The nodes that intersect have their
/// centers within m of a circle of radius r: about 4 pi r m / 2 m^2 = 6.3 r / m; on a smooth scan, 5.6 were measured.
/// 14 is chosen: a little more than two such sheets. So is 12, for balls no larger than a node: a group and a half.
std::size_t most_intersecting(double radius_in_frame, double mean_radius) {
  return 12 + static_cast<std::size_t>(std::min(14 * radius_in_frame / mean_radius, 1e9));
}

}  // namespace

void Waves::run(NodeId home, const TreeBall& ball, GroupStates& states) {
  groups_.clear();
  next_wave_.clear();
  meet(home, states);
  for (std::size_t placed = 0; !next_wave_.empty();) {
    std::swap(wave_, next_wave_);
    next_wave_.clear();
    place(placed, ball, states);
    placed = groups_.size();
    for (const std::uint32_t group : wave_) spread(group, states);
  }
  // What was not reached is not connected with the query vertex. To look at it again would only take time.
  for (const std::uint32_t group : groups_) {
    GroupState& state = states[group];
    state.whole &= state.reached;
    state.intersecting &= state.reached;
  }
}

/// Makes a node pending that is linked with a reached one.
void Waves::meet(NodeId node, GroupStates& states) {
  const std::uint32_t group = node / kFanOut;
  const NodeSet bit = node_at(node % kFanOut);
  if (!states.is_known(group)) {
    states.set(group, {}).pending = bit;
    groups_.push_back(group);
    next_wave_.push_back(group);
    fetch_lines(&index_->groups[group], sizeof(Group) / kCacheLine);
    prefetch(&index_->records[group]);
    return;
  }
  GroupState& state = states[group];
  if ((state.reached & bit) != 0) return;
  if (state.pending == 0) next_wave_.push_back(group);
  state.pending |= bit;
}

/// Compares the groups met since the last wave with the ball.
void Waves::place(std::size_t first_new, const TreeBall& ball, GroupStates& states) {
  const auto met = std::span(groups_).subspan(first_new);
  if (containments_.size() < met.size()) containments_.resize(2 * met.size());
  kernels_->classify(index_->groups.data(), met, ball, containments_.data());
  for (std::size_t i = 0; i < met.size(); ++i) {
    GroupState& state = states[met[i]];
    const GroupRecord& record = index_->records[met[i]];
    state.place(record, containments_[i]);
    fetch_lines(index_->node_links.data() + record.first_link, 2);
  }
}

/// Reaches what is pending in the group and what is linked with it there, and meets their links.
void Waves::spread(std::uint32_t group, GroupStates& states) {
  const GroupRecord& record = index_->records[group];
  GroupState& state = states[group];
  const auto open = static_cast<NodeSet>((state.whole | state.intersecting) & ~state.reached);
  const NodeSet from = state.pending & open;
  state.pending = 0;
  if (from == 0) return;
  const NodeSet added = reachable_nodes(record.linked, from, open);
  state.reached |= added;
  for (const NodeLink& link : index_->node_links_of(record)) {
    if ((link.mine & added) != 0) meet(link.node(), states);
  }
}

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
  // This writes eight nodes and keeps those in the set, which is faster than a branch for each.
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

/// Begins with large nodes, which are few. Where they reach more than a single sheet, begins again with small ones,
/// which leave out what is not connected at that scale. Leaves save nothing over a search along their links.
bool Reach::run(const Query& query) {
  // The radius of the ball is at most this many mean radii of nodes.
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

/// Returns the node over the query vertex on the lowest level whose mean radius is at least the radius over `ratio`.
Reach::Home Reach::home_of(const Query& query, double ratio) const {
  Home home{0, query.leaf()};
  for (; index_->tree[home.level].mean_radius * ratio < query.radius_in_frame; ++home.level) {
    const NodeId parent = index_->parents[home.node / kFanOut];
    if (parent == kNoNode) break;
    home.node = parent;
  }
  return home;
}

/// Returns false if on a level above `limited_above` more nodes intersect the surface of the ball than one sheet has.
bool Reach::reach_from(const Home& home, const Query& query, std::size_t limited_above) {
  states_.start(index_->tree[home.level].first_group + index_->tree[home.level].groups);
  waves_.run(home.node, query.tree_ball, states_);
  return descent_.run(home.level, waves_.groups(), query, limited_above, states_);
}

void Reach::find_surface_leaves(const Query& query) {
  constexpr std::size_t kLeavesAhead = 10;
  const std::span<const LeafId> leaves = descent_.surface_leaves();
  // The runs are in records of groups, which the descent has just read.
  const auto prefetch_vertices = [&](LeafId leaf) {
    const VertexId first = run_of(*index_, leaf).begin;
    prefetch_positions(*index_, first, kLeafCapacity);
    fetch_lines(&index_->adjacency[first], 3);
    prefetch(&index_->leaves[leaf]);
  };
  for (const LeafId leaf : leaves.first(std::min(kLeavesAhead, leaves.size()))) prefetch_vertices(leaf);
  surface_leaves_.clear();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kLeavesAhead < leaves.size()) prefetch_vertices(leaves[i + kLeavesAhead]);
    const auto [first, end] = run_of(*index_, leaves[i]);
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

/// Settles a leaf whose sphere intersects the surface of the ball, but whose vertices are all inside or all outside.
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
