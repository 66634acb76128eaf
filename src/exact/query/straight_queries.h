// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "exact/query/flood.h"
#include "exact/query/single_queries.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// A vertex that the flood has reached in its last step.
struct NextVertex {
  double distance;  // from the center
  VertexId vertex;

  friend auto operator<=>(const NextVertex&, const NextVertex&) = default;
};

/// Answers queries by the straight metric: one ball around a vertex by `StraightSearch`, all else by a flood. Each is
/// made when it is first needed.
struct StraightQueries final : SingleQueries {
  StraightQueries(BoundIndex bound, std::shared_ptr<KeptGraph> kept, Isa chosen)
      : SingleQueries(std::move(bound), std::move(kept), Metric::Straight, chosen) {}

  void rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept) override;
  VertexSet& search(const Start& start, double radius) override;
  void collect(const Start& start, double radius, std::vector<LeafSubset>& found) override;
  void nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& ids,
              std::vector<std::size_t>& sizes) override;
  bool contains(const Start& start, VertexId w, double radius) override;
  double connecting_radius(const Start& start, VertexId w) override;
  void nearest(const Start& start, std::size_t k, std::vector<VertexId>& ids, std::vector<double>& radii) override;

  [[nodiscard]] StraightSearch& straight_search() {
    if (!straight_search_) straight_search_.emplace(index, graph, isa);
    return *straight_search_;
  }

  /// Calls `f(vertex, radius)` for the vertices that are not ignored by their connecting radius, then by distance from
  /// the center, then by id, until it returns false or there is none whose radius is at most `most`.
  template <class F>
  void for_each_nearest(const Start& start, double most, F&& f);

 private:
  /// Begins a flood with nothing reached.
  Flood& begin(const Start& start);

  /// Adds what the flood has reached, except in its first `skip` steps, without ignored vertices.
  void add_reached(std::size_t skip, std::vector<LeafSubset>& found) const;

  std::optional<StraightSearch> straight_search_;
  std::optional<Flood> flood_;
  std::vector<LeafSubset> found_;  // scratch
  std::vector<NextVertex> ring_;   // scratch
};

template <class F>
void StraightQueries::for_each_nearest(const Start& start, double most, F&& f) {
  const Point center = center_of(start);
  Flood& flood = begin(start);
  for (;;) {
    const double radius = flood.next_radius();
    if (!(radius <= most) || radius == kNoRadius) return;
    const std::size_t before = flood.reached().size();
    flood.grow(radius);
    found_.clear();
    add_reached(before, found_);
    ring_.clear();
    for (const LeafSubset& subset : found_) {
      for_each_lane(subset.lanes, [&](unsigned lane) {
        const double square = squared_distance(index->position(subset.leaf, lane), center);
        ring_.push_back({std::sqrt(square), index->id(index->leaf_begin[subset.leaf] + lane)});
      });
    }
    std::sort(ring_.begin(), ring_.end());
    for (const NextVertex& next : ring_) {
      if (!f(next.vertex, radius)) return;
    }
  }
}

}  // namespace meshhood::inline v0_1
