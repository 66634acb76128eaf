// SPDX-License-Identifier: MIT
// At which radius vertices become connected. A flood grows until it has reached them.
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "exact/query/arguments.h"
#include "exact/query/region_state.h"
#include "shared/distance.h"

namespace meshhood {
namespace {

constexpr double kNoRadius = std::numeric_limits<double>::infinity();

}  // namespace

bool RegionSearcher::contains(const Start& start, VertexId w, double radius) {
  State& state = *state_;
  state.check(start);
  check_vertex(w, state.index->vertex_count(), "vertex");
  check_radius(radius);
  const Point center = state.begin(start);
  const std::uint32_t slot = state.slot(w);
  if (!(squared_distance(position_of(*state.index, w), center) <= squared_radius(radius))) return false;
  if (state.is_ignored(slot)) return false;
  state.flood.grow(radius, slot);
  return state.flood.has_reached(slot);
}

double RegionSearcher::connecting_radius(const Start& start, VertexId w) {
  State& state = *state_;
  state.check(start);
  check_vertex(w, state.index->vertex_count(), "vertex");
  const Point center = state.begin(start);
  const std::uint32_t slot = state.slot(w);
  if (state.is_ignored(slot)) return kNoRadius;
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
                                       std::vector<double>& radii) {
  State& state = *state_;
  state.check(start);
  std::vector<VertexId> ids;
  std::vector<double> found_radii;
  const auto add = [&](VertexId vertex, double radius) {
    ids.push_back(vertex);
    found_radii.push_back(radius);
    return ids.size() < k;
  };
  if (k > 0) state.for_each_nearest(start, kNoRadius, add);
  out = std::move(ids);
  radii = std::move(found_radii);
}

}  // namespace meshhood
