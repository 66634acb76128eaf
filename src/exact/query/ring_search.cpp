// SPDX-License-Identifier: MIT
#include "exact/query/ring_search.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/epoch_array.h"
#include "exact/layout.h"
#include "exact/query/length_search.h"
#include "exact/search/vertex_bfs.h"
#include "exact/vertex_set.h"
#include "simd/kernels.h"

namespace meshhood::inline v0_1 {
namespace {

/// Breadth-first search by the number of edges, ring after ring. The vertices of a leaf that belong to one ring are one
/// word.
class LeafRings {
 public:
  LeafRings(const IndexView& index, const Kernels& kernels)
      : index_(&index), kernels_(&kernels), states_(index.leaf_count()) {}

  /// Begins with ring 0, the vertex `slot`; with nothing if it is a wall.
  void start(std::uint32_t slot) {
    next_leaves_.clear();
    ring_.clear();
    states_.forget();
    const LaneMask lane = LaneMask{1} << lane_of(slot);
    State& state = state_of(leaf_of(slot));
    if ((state.seen & lane) != 0) return;
    state.seen |= lane;
    ring_.push_back({leaf_of(slot), lane});
  }

  /// Returns the last ring, each leaf once.
  [[nodiscard]] std::span<const LeafSubset> ring() const { return ring_; }

  /// Goes on to the next ring, which is empty if there is none.
  void advance() {
    for (const LeafSubset& subset : ring_) {
      LaneMask neighbors = 0;
      const std::size_t first = index_->leaf_begin[subset.leaf];
      for_each_lane(subset.lanes, [&](unsigned lane) { neighbors |= index_->adjacency[first + lane]; });
      add(subset.leaf, neighbors);
      for (const Link& link : index_->links_of(subset.leaf)) {
        if ((link.boundary & subset.lanes) == 0) continue;
        add(link.leaf, kernels_->cross_edges(index_->cross_edges_of(link), subset.lanes));
      }
    }
    ring_.clear();
    for (const LeafId leaf : next_leaves_) {
      State& state = states_[leaf];
      assert(state.next != 0 && (state.next & state.seen) == 0);  // a leaf is listed once, its vertices are new
      ring_.push_back({leaf, state.next});
      state.seen |= state.next;
      state.next = 0;
    }
    next_leaves_.clear();
  }

 private:
  /// The state of a leaf in one search.
  struct State {
    LaneMask seen = 0;  // in a ring before the next, or walls
    LaneMask next = 0;  // in the next ring
  };

  State& state_of(LeafId leaf) {
    return states_.is_known(leaf) ? states_[leaf] : states_.set(leaf, {.seen = ~index_->open_lanes(leaf)});
  }

  /// Adds those of the vertices to the next ring that are in none yet.
  void add(LeafId leaf, LaneMask lanes) {
    State& state = state_of(leaf);
    const LaneMask added = lanes & ~(state.seen | state.next);
    if (added == 0) return;
    if (state.next == 0) next_leaves_.push_back(leaf);
    state.next |= added;
  }

  const IndexView* index_;
  const Kernels* kernels_;
  EpochArray<State> states_;  // by leaf
  std::vector<LeafSubset> ring_;
  std::vector<LeafId> next_leaves_;
};

class RingSearch final : public LengthSearch {
 public:
  RingSearch(const IndexView& index, KeptGraph& graph, const Kernels& kernels)
      : LengthSearch(index), by_leaf_(index, kernels) {
    if (is_unlike_a_surface(index)) by_vertex_.emplace(index, graph);
  }

  void run(std::span<const Path> starts, double radius, const OnFound& on_found) override {
    const std::uint32_t slot = index_->slot_at(starts.front().end);
    found_.clear();
    subsets_.clear();
    by_vertex_ ? run_by_vertex(slot, radius, on_found) : run_by_leaf(slot, radius, on_found);
  }

  std::span<const Path> found() override { return found_; }
  std::span<const Path> in_order() override { return found_; }

  void collect(std::vector<LeafSubset>& subsets) override {
    if (by_vertex_) return LengthSearch::collect(subsets);
    subsets.insert(subsets.end(), subsets_.begin(), subsets_.end());
  }

 private:
  /// Searches twice as many rings each time, so that all searches take at most about twice as long as the last; it
  /// begins with all if all are wanted.
  void run_by_vertex(std::uint32_t slot, double radius, const OnFound& on_found) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    const auto most = static_cast<std::uint32_t>(std::min(radius, kMost));
    std::uint32_t known = 0;  // the number of rings found
    for (std::uint32_t count = on_found ? std::min(most, 1U) : most;; count = count > most / 2 ? most : 2 * count) {
      by_vertex_->run(slot, count);
      const auto edges_to = [this](std::uint32_t place) { return by_vertex_->edges_to(place); };
      for (;; ++known) {
        const auto ring = std::ranges::equal_range(by_vertex_->reached(), known, {}, edges_to);
        if (ring.empty()) break;
        const std::size_t before = found_.size();
        for (const std::uint32_t place : ring) {
          if (!index_->is_ignored_at(place)) found_.push_back({static_cast<double>(known), place});
        }
        const std::span<Path> added = std::span(found_).subspan(before);
        std::ranges::sort(added, {}, &Path::end);
        if (on_found && on_found(added)) return;
      }
      if (count == most || known <= count) return;
    }
  }

  void run_by_leaf(std::uint32_t slot, double radius, const OnFound& on_found) {
    double edges = 0;
    for (by_leaf_.start(slot); edges <= radius && !by_leaf_.ring().empty(); by_leaf_.advance()) {
      const std::size_t before = found_.size();
      ring_.assign(by_leaf_.ring().begin(), by_leaf_.ring().end());
      std::ranges::sort(ring_, {}, &LeafSubset::leaf);
      for (const auto& [leaf, all] : ring_) {
        const LaneMask lanes = all & ~index_->ignored_lanes(leaf);
        if (lanes == 0) continue;
        subsets_.push_back({leaf, lanes});
        const std::uint32_t first = index_->leaf_begin[leaf];
        for_each_lane(lanes, [&](unsigned lane) { found_.push_back({edges, first + lane}); });
      }
      if (on_found && on_found(std::span(found_).subspan(before))) return;
      ++edges;
    }
  }

  LeafRings by_leaf_;
  std::optional<VertexRings> by_vertex_;  // for a graph unlike a surface, instead
  std::vector<LeafSubset> ring_;
  std::vector<Path> found_;
  std::vector<LeafSubset> subsets_;  // the same, leaf by leaf
};

}  // namespace

std::size_t VertexRings::run(std::uint32_t slot, std::uint32_t rings) {
  const Adjacency& edges = *graph_->edges_of(*index_);
  edges_to_.forget();
  found_.clear();
  places_.clear();
  pieces_.clear();
  queue_.clear();
  const auto reach = [&](std::uint32_t place, std::uint32_t count) {
    if (edges_to_.is_known(place)) return;
    edges_to_.set(place, count);
    if (!index_->is_wall_at(place)) queue_.push_back(place);
  };
  reach(index_->place_at(slot), 0);
  std::size_t count = 0;
  // NOLINTNEXTLINE(modernize-loop-convert): the queue grows meanwhile
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::uint32_t place = queue_[head];
    if (!index_->is_ignored_at(place)) {
      found_.insert(place);
      ++count;
    }
    const std::uint32_t next = edges_to_[place] + 1;
    if (next > rings || next == 0) continue;  // all that follow are as far
    for (std::size_t i = edges.offsets[place]; i < edges.offsets[place + std::size_t{1}]; ++i) {
      reach(edges.neighbors[i], next);
    }
  }
  return count;
}

std::span<const std::uint32_t> VertexRings::places() {
  found_.take_all([&](std::size_t place) { places_.push_back(static_cast<std::uint32_t>(place)); });
  return places_;
}

std::span<const Piece> VertexRings::pieces() {
  if (!pieces_.empty()) return pieces_;
  words_.clear();
  for (const std::uint32_t place : places()) {
    const std::uint32_t slot = index_->slot_at(place);
    const LeafId leaf = leaf_of(slot);
    if (pieces_.empty() || pieces_.back().leaves.begin != leaf) {
      pieces_.push_back({{leaf, leaf + 1}, 0, nullptr});
      words_.push_back({});
    }
    words_.back()[lane_of(slot)] = 1;
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) pieces_[i].reached = words_[i].data();
  return pieces_;
}

std::unique_ptr<LengthSearch> make_ring_search(const IndexView& index, KeptGraph& graph, const Kernels& kernels) {
  return std::make_unique<RingSearch>(index, graph, kernels);
}

}  // namespace meshhood::inline v0_1
