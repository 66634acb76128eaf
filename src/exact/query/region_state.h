// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "meshhood/region.h"

#include "exact/bound_index.h"
#include "exact/layout.h"
#include "exact/query/flood.h"
#include "exact/search/searcher_state.h"
#include "exact/vertex_set.h"
#include "shared/distance.h"
#include "simd/kernels.h"

namespace meshhood {

/// A vertex that the flood has reached in its last step.
struct NextVertex {
  double distance;  // from the center
  VertexId vertex;

  friend bool operator<(const NextVertex& a, const NextVertex& b) {
    return std::tie(a.distance, a.vertex) < std::tie(b.distance, b.vertex);
  }
};

/// The scratch memory of a region searcher, and what its queries share.
struct RegionSearcher::State {
  BoundIndex index;
  std::shared_ptr<KeptGraph> graph;  // of odd graphs
  Isa isa;
  const Kernels* kernels;
  Flood flood;
  std::vector<LeafSubset> found;  // scratch
  std::vector<NextVertex> ring;   // scratch
  VertexSet answer;
  std::unique_ptr<SearcherAccess::State> neighborhoods;

  State(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Isa chosen)
      : index(std::move(bound)),
        graph(std::move(kept)),
        isa(chosen),
        kernels(&meshhood::kernels(isa)),
        flood(*index, *kernels),
        answer(*index) {}

  /// Throws unless the arguments of a query are valid. `where` begins the messages.
  void check(const Start& start, std::string_view where = {}) const;

  [[nodiscard]] Point center_of(const Start& start) const;

  /// Begins a flood from valid arguments, with nothing reached. Returns its center.
  Point begin(const Start& start);

  /// Whether the region of a valid start is the neighborhood of its vertex.
  [[nodiscard]] static bool is_neighborhood(const Start& start) { return !start.center(); }

  /// Whether a seed lies in the ball, when the flood of a valid start has grown to `radius`.
  [[nodiscard]] bool has_seed(const Start& start, double radius) const;

  /// The searcher of neighborhoods, made when first needed.
  [[nodiscard]] SearcherAccess::State& searcher();

  /// The slot of a vertex, whose id is valid.
  [[nodiscard]] std::uint32_t slot(VertexId v) const { return index->slot[v]; }

  [[nodiscard]] bool is_ignored(std::uint32_t slot) const {
    return (index->ignored_lanes(leaf_of(slot)) >> lane_of(slot) & 1U) != 0;
  }

  /// Calls `f(subset)` for the vertices that the flood has reached, except in its first `skip` steps, and that are not
  /// ignored.
  template <class F>
  void for_each_found(std::size_t skip, F&& f) const {
    for (const LeafSubset& subset : flood.reached().subspan(skip)) {
      const LaneMask lanes = subset.lanes & ~index->ignored_lanes(subset.leaf);
      if (lanes != 0) f(LeafSubset{subset.leaf, lanes});
    }
  }

  /// Refills `answer` with what was found, except in the first `skip` steps of the flood.
  void collect_found(std::size_t skip = 0);

  /// Calls `f(vertex, radius)` for the vertices that are not ignored by their connecting radius, then by distance from
  /// the center, then by id, until it returns false or there is none whose radius is at most `most`. The start is
  /// valid.
  template <class F>
  void for_each_nearest(const Start& start, double most, F&& f);

  /// Refills `answer` with the region, and returns its center.
  Point search(const Start& start, double radius);
};

template <class F>
void RegionSearcher::State::for_each_nearest(const Start& start, double most, F&& f) {
  const Point center = begin(start);
  for (;;) {
    const double radius = flood.next_radius();
    if (!(radius <= most) || radius == std::numeric_limits<double>::infinity()) return;
    const std::size_t before = flood.reached().size();
    flood.grow(radius);
    ring.clear();
    for_each_found(before, [&](const LeafSubset& subset) {
      for_each_lane(subset.lanes, [&](unsigned lane) {
        const double square = squared_distance(index->position(subset.leaf, lane), center);
        ring.push_back({std::sqrt(square), index->id(index->leaf_begin[subset.leaf] + lane)});
      });
    });
    std::sort(ring.begin(), ring.end());
    for (const NextVertex& next : ring) {
      if (!f(next.vertex, radius)) return;
    }
  }
}

/// Access to the parts of a region searcher, for batches and tests.
struct RegionAccess {
  static RegionSearcher::State& state(RegionSearcher& searcher) { return *searcher.state_; }
  static Flood& flood(RegionSearcher& searcher) { return searcher.state_->flood; }
  static void set_isa(RegionSearcher& searcher, Isa isa) {
    searcher.state_ = std::make_unique<RegionSearcher::State>(searcher.state_->index, searcher.state_->graph, isa);
  }
};

}  // namespace meshhood
