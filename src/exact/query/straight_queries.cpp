// SPDX-License-Identifier: MIT
#include "exact/query/straight_queries.h"

namespace meshhood::inline v0_1 {

void StraightQueries::rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept) {
  SingleQueries::rebind(std::move(bound), std::move(kept));
  if (straight_search_) straight_search_->rebind(index, graph);
}

Flood& StraightQueries::begin(const Start& start) {
  if (!flood_) flood_.emplace(*index, *kernels);
  flood_->start(center_of(start));
  for (const VertexId seed : start.seeds()) flood_->add_seed(index->slot[seed]);
  return *flood_;
}

void StraightQueries::add_reached(std::size_t skip, std::vector<LeafSubset>& found) const {
  for (const LeafSubset& subset : flood_->reached().subspan(skip)) {
    const LaneMask lanes = subset.lanes & ~index->ignored_lanes(subset.leaf);
    if (lanes != 0) found.push_back({subset.leaf, lanes});
  }
}

VertexSet& StraightQueries::search(const Start& start, double radius) {
  if (!start.center()) {
    straight_search().search(start.vertex(), radius);  // it checks the arguments
    return straight_search_->answer;
  }
  check(start);
  check_radius(radius);
  found_.clear();
  collect(start, radius, found_);
  answer.assign(found_);
  return answer;
}

void StraightQueries::collect(const Start& start, double radius, std::vector<LeafSubset>& found) {
  begin(start).grow(radius);
  add_reached(0, found);
}

void StraightQueries::nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& ids,
                             std::vector<std::size_t>& sizes) {
  if (!start.center()) return SingleQueries::nested(start, radii, ids, sizes);
  Flood& flood = begin(start);
  for (const double radius : radii) {
    const std::size_t before = flood.reached().size();
    flood.grow(radius);
    found_.clear();
    add_reached(before, found_);
    answer.assign(found_);
    append_ids(answer, *index, *kernels, ids);
    sizes.push_back(ids.size());
  }
}

bool StraightQueries::contains(const Start& start, VertexId w, double radius) {
  const std::uint32_t slot = index->slot[w];
  if (!(squared_distance(index->position_of(w), center_of(start)) <= squared_radius(radius))) return false;
  if (index->is_ignored(slot)) return false;
  Flood& flood = begin(start);
  flood.grow(radius, slot);
  return flood.has_reached(slot);
}

double StraightQueries::connecting_radius(const Start& start, VertexId w) {
  const std::uint32_t slot = index->slot[w];
  if (index->is_ignored(slot)) return kNoRadius;
  // No smaller ball holds `w` itself.
  double radius = std::sqrt(squared_distance(index->position_of(w), center_of(start)));
  Flood& flood = begin(start);
  flood.grow(radius, slot);
  while (!flood.has_reached(slot)) {
    radius = flood.next_radius();
    if (radius == kNoRadius) return kNoRadius;
    flood.grow(radius, slot);
  }
  return radius;
}

void StraightQueries::nearest(const Start& start, std::size_t k, std::vector<VertexId>& ids,
                              std::vector<double>& radii) {
  for_each_nearest(start, kNoRadius, [&](VertexId vertex, double radius) {
    ids.push_back(vertex);
    radii.push_back(radius);
    return ids.size() < k;
  });
}

}  // namespace meshhood::inline v0_1
