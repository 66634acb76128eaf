// SPDX-License-Identifier: MIT
// At which radius vertices become connected. A flood grows until it has reached them.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include "exact/query/arguments.h"
#include "exact/query/region_state.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

constexpr double kNoRadius = std::numeric_limits<double>::infinity();

struct NextVertex {
  double distance;
  VertexId vertex;

  friend bool operator<(const NextVertex& a, const NextVertex& b) {
    return std::tie(a.distance, a.vertex) < std::tie(b.distance, b.vertex);
  }
};

}  // namespace

bool RegionSearcher::contains(const Start& start, VertexId w, double radius, const Filter& filter) {
  State& state = *state_;
  state.check(start);
  check_vertex(w, state.index->vertex_count(), "vertex");
  check_radius(radius);
  state.check(filter);
  const Point center = state.begin(start, filter);
  const std::uint32_t slot = state.slot(w);
  if (!(squared_distance(position_of(*state.index, w), center) <= squared_radius(radius))) return false;
  if (state.ignored.has(w)) return false;
  state.flood.grow(radius, slot);
  return state.flood.has_reached(slot);
}

double RegionSearcher::connecting_radius(const Start& start, VertexId w, const Filter& filter) {
  State& state = *state_;
  state.check(start);
  check_vertex(w, state.index->vertex_count(), "vertex");
  state.check(filter);
  const Point center = state.begin(start, filter);
  const std::uint32_t slot = state.slot(w);
  if (state.ignored.has(w)) return kNoRadius;
  // No smaller ball holds `w` itself.
  double radius = std::sqrt(squared_distance(position_of(*state.index, w), center));
  state.flood.grow(radius, slot);
  while (!state.flood.has_reached(slot)) {
    radius = state.flood.next_radius();
    if (radius == kNoRadius) return kNoRadius;
    state.flood.grow(radius, slot);
  }
  return radius;
}

void RegionSearcher::nearest_connected(const Start& start, std::size_t k, std::vector<VertexId>& out,
                                       std::vector<double>& radii, const Filter& filter) {
  State& state = *state_;
  state.check(start);
  state.check(filter);
  const Point center = state.begin(start, filter);
  std::vector<VertexId> ids;
  std::vector<double> found_radii;
  std::vector<NextVertex> ring;
  while (ids.size() < k) {
    const double radius = state.flood.next_radius();
    if (radius == kNoRadius) break;
    const std::size_t before = state.flood.reached().size();
    state.flood.grow(radius);
    ring.clear();
    state.for_each_found(before, [&](const LeafSubset& subset) {
      for_each_lane(subset.lanes, [&](unsigned lane) {
        const double square = squared_distance(state.index->position(subset.leaf, lane), center);
        ring.push_back({std::sqrt(square), state.index->id(state.index->leaf_begin[subset.leaf] + lane)});
      });
    });
    const std::size_t count = std::min(ring.size(), k - ids.size());
    std::partial_sort(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(count), ring.end());
    for (std::size_t i = 0; i < count; ++i) ids.push_back(ring[i].vertex);
    found_radii.resize(ids.size(), radius);
  }
  out = std::move(ids);
  radii = std::move(found_radii);
}

}  // namespace meshhood
