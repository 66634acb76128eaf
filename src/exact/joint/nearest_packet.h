// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/layout.h"
#include "exact/query/path_search.h"
#include "simd/ball.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {

/// Finds the vertices around each vertex of a leaf by connecting radius, up to a radius: the vertices in the ball are
/// taken by distance, and one is reached when it has a reached neighbor, or as soon as it gains one. Its connecting
/// radius is the distance of the vertex that was taken then. The leaves that the balls meet, and the edges between
/// them, are gathered once for all vertices of the leaf.
///
/// Each thread needs its own. It owns 8 bytes a leaf of the mesh, and 0.5 kB for each leaf that it gathers. What is
/// found does not depend on earlier calls.
class NearestPacket {
 public:
  NearestPacket(const IndexView& index, Isa isa)
      : index_(&index), kernels_(&kernels(isa)), numbers_(index.leaf_count()) {}

  /// Gathers what the balls of `radius` around the vertices of `leaf` meet, as far as it is linked. Returns false if
  /// that is more than `most` leaves.
  [[nodiscard]] bool gather(LeafId leaf, double radius, std::size_t most);

  /// Returns whether all that is connected with the leaf was gathered.
  [[nodiscard]] bool is_whole() const { return is_whole_; }

  /// Calls `f(vertex, radius)` for the vertices connected with that in `lane` of the leaf that are not ignored, by
  /// connecting radius, then by distance, then by id, until `f` returns false or the next has more than `most`, which
  /// is at most the radius of `gather`. Returns whether `f` never did.
  template <class F>
  bool for_each_near(unsigned lane, double most, F&& f);

 private:
  /// A leaf that was gathered.
  struct Entry {
    LeafId leaf;
    FrameSphere bounds;
    std::uint32_t first;
    std::uint32_t size;
    LaneMask open;     // no walls
    LaneMask ignored;  // in no answer
  };

  /// The state of the vertices of an entry in one search.
  struct State {
    LaneMask reached = 0;
    LaneMask waiting = 0;  // taken, but without a reached neighbor
  };

  /// An edge to a vertex of another leaf.
  struct Edge {
    std::uint32_t to;
    std::uint32_t before;  // of the same vertex; or kNone
  };

  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  void add(LeafId leaf);
  void list_edges();
  std::span<const Path> vertices_in_ball(unsigned lane, double radius);
  [[nodiscard]] bool has_reached_neighbor(std::uint32_t at) const;
  [[nodiscard]] bool has_reached_neighbor_beyond(std::uint32_t at) const;
  void reach(std::uint32_t at);
  void reach_waiting();
  std::span<const Path> take_ring();

  const IndexView* index_;
  const Kernels* kernels_;
  bool is_whole_ = false;
  EpochArray<std::uint32_t> numbers_;  // by leaf: its place in `entries_`; kNone if it was left out
  std::vector<Entry> entries_;         // the first is that of the queries
  // `last_edge_` is by vertex of these leaves: 32 times the number of its leaf plus its lane.
  std::vector<std::uint32_t> last_edge_;  // to another leaf, in `edges_`; or kNone
  std::vector<Edge> edges_;
  // These belong to one search.
  std::vector<PerLane<double>> squares_;  // of distances, by leaf, where the ball meets it
  std::vector<Path> in_ball_;             // the vertices in the ball, with these
  PathOrder order_;
  std::vector<State> states_;
  std::size_t waiting_count_ = 0;
  std::vector<std::uint32_t> reached_;  // vertices of the same connecting radius, not passed on yet
  std::vector<Path> ring_;              // the same with their ids, by distance, then by id
};

template <class F>
bool NearestPacket::for_each_near(unsigned lane, double most, F&& f) {
  if ((entries_.front().open >> lane & 1U) == 0) return true;
  states_.assign(entries_.size(), {});
  waiting_count_ = 0;
  reached_.clear();
  reach(lane);
  double radius = 0;
  // Calls `f` for the vertices reached since the last call. Most often, that is one.
  const auto pass_on = [&] {
    if (reached_.size() == 1) {
      const std::uint32_t at = reached_.front();
      reached_.clear();
      const Entry& entry = entries_[leaf_of(at)];
      return (entry.ignored >> lane_of(at) & 1U) != 0 || f(index_->id(entry.first + lane_of(at)), radius);
    }
    for (const Path& next : take_ring()) {
      if (!f(static_cast<VertexId>(next.end), radius)) return false;
    }
    return true;
  };
  for (const auto& [square, at] : vertices_in_ball(lane, most)) {
    const double distance = std::sqrt(square);  // different squares may have the same root
    if (distance > radius && !reached_.empty() && !pass_on()) return false;
    if (!has_reached_neighbor(at)) {
      states_[leaf_of(at)].waiting |= LaneMask{1} << lane_of(at);
      ++waiting_count_;
      continue;
    }
    radius = distance;
    reach(at);
  }
  return pass_on();
}

inline bool NearestPacket::has_reached_neighbor(std::uint32_t at) const {
  const std::uint32_t leaf = leaf_of(at);
  return (index_->adjacency[entries_[leaf].first + lane_of(at)] & states_[leaf].reached) != 0 ||
         has_reached_neighbor_beyond(at);
}

/// Reaches a vertex, and the waiting ones that it connects. Few vertices ever wait.
inline void NearestPacket::reach(std::uint32_t at) {
  states_[leaf_of(at)].reached |= LaneMask{1} << lane_of(at);
  reached_.push_back(at);
  if (waiting_count_ != 0) reach_waiting();
}

}  // namespace meshhood::inline v0_1
