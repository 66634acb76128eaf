// SPDX-License-Identifier: MIT
#include "exact/joint/nearest_packet.h"

#include <algorithm>
#include <utility>

namespace meshhood::inline v0_1 {

bool NearestPacket::gather(LeafId leaf, double radius, std::size_t most) {
  is_whole_ = true;
  entries_.clear();
  numbers_.forget();
  const FrameSphere& bounds = index_->leaves[leaf].bounds;
  TreeBall around({bounds.x, bounds.y, bounds.z}, TreeBounds(index_->frame, radius));
  around.outer = next_above(static_cast<double>(around.outer) + static_cast<double>(bounds.radius));
  add(leaf);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (i == most) return false;
    for (const Link& link : index_->links_of(entries_[i].leaf)) {
      if (numbers_.is_known(link.leaf)) continue;
      if (classify(index_->leaves[link.leaf].bounds, around) == Containment::Outside) {
        numbers_.set(link.leaf, kNone);
        is_whole_ = false;
      } else {
        add(link.leaf);
      }
    }
  }
  list_edges();
  return true;
}

void NearestPacket::add(LeafId leaf) {
  const Leaf& record = index_->leaves[leaf];
  numbers_.set(leaf, static_cast<std::uint32_t>(entries_.size()));
  entries_.push_back(
      {leaf, record.bounds, record.first, record.size, index_->open_lanes(leaf), index_->ignored_lanes(leaf)});
}

void NearestPacket::list_edges() {
  edges_.clear();
  last_edge_.assign(kLeafCapacity * entries_.size(), kNone);
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    for (const Link& link : index_->links_of(entries_[i].leaf)) {
      const std::uint32_t other = numbers_[link.leaf];
      if (other == kNone) continue;
      for (const CrossEdge& edge : index_->cross_edges_of(link)) {
        std::uint32_t& last = last_edge_[kLeafCapacity * i + edge.from];
        edges_.push_back({kLeafCapacity * other + edge.to, last});
        last = static_cast<std::uint32_t>(edges_.size() - 1);
      }
    }
  }
}

/// Returns the vertices in the ball but the center, by distance, with its square.
std::span<const Path> NearestPacket::vertices_in_ball(unsigned lane, double radius) {
  const Point center = index_->position(entries_.front().leaf, lane);
  const LeafBall ball(center, LeafBounds(radius));
  const TreeBall tree_ball(index_->frame, center, radius);
  squares_.resize(entries_.size());
  in_ball_.resize(kLeafCapacity * entries_.size());
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    if (classify(entry.bounds, tree_ball) == Containment::Outside) continue;
    PerLane<double>& squares = squares_[i];
    LaneMask inside = kernels_->squares(index_->positions, entry.first, entry.size, ball, squares) & entry.open;
    if (i == 0) inside &= ~(LaneMask{1} << lane);
    for_each_lane(inside, [&](unsigned other) { in_ball_[count++] = {squares[other], kLeafCapacity * i + other}; });
  }
  return order_.sorted(std::span(in_ball_).first(count));
}

/// Returns whether a vertex has a reached neighbor in another leaf.
bool NearestPacket::has_reached_neighbor_beyond(std::uint32_t at) const {
  for (std::uint32_t i = last_edge_[at]; i != kNone; i = edges_[i].before) {
    const std::uint32_t to = edges_[i].to;
    if ((states_[leaf_of(to)].reached >> lane_of(to) & 1U) != 0) return true;
  }
  return false;
}

/// Reaches the waiting vertices that the last one connects.
void NearestPacket::reach_waiting() {
  for (std::size_t head = reached_.size() - 1; head < reached_.size(); ++head) {
    const std::uint32_t from = reached_[head];
    State& state = states_[leaf_of(from)];
    const auto connect = [&](State& other, std::uint32_t to) {
      other.waiting &= ~(LaneMask{1} << lane_of(to));
      other.reached |= LaneMask{1} << lane_of(to);
      --waiting_count_;
      reached_.push_back(to);
    };
    const LaneMask neighbors = index_->adjacency[entries_[leaf_of(from)].first + lane_of(from)];
    for_each_lane(state.waiting & neighbors, [&](unsigned lane) { connect(state, from - lane_of(from) + lane); });
    for (std::uint32_t i = last_edge_[from]; i != kNone; i = edges_[i].before) {
      const std::uint32_t to = edges_[i].to;
      State& other = states_[leaf_of(to)];
      if ((other.waiting >> lane_of(to) & 1U) != 0) connect(other, to);
    }
  }
}

/// Returns the vertices reached since the last call that are not ignored, with their squared distances, by distance,
/// then by id.
std::span<const Path> NearestPacket::take_ring() {
  ring_.clear();
  for (const std::uint32_t at : reached_) {
    const Entry& entry = entries_[leaf_of(at)];
    if ((entry.ignored >> lane_of(at) & 1U) != 0) continue;
    ring_.push_back({squares_[leaf_of(at)][lane_of(at)], index_->id(entry.first + lane_of(at))});
  }
  reached_.clear();
  // Different squares may have the same root.
  std::ranges::sort(ring_, {}, [](const Path& path) { return std::pair(std::sqrt(path.length), path.end); });
  return ring_;
}

}  // namespace meshhood::inline v0_1
