// SPDX-License-Identifier: MIT
// The region of one start and one radius: a flood that grows once.
#include "meshhood/region.h"

#include "base/distance.h"
#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/region_state.h"
#include "exact/search/output.h"

namespace meshhood {

void RegionSearcher::State::check(const Start& start, std::string_view where) const {
  check_start(start, index->vertex_count(), where);
}

void RegionSearcher::State::check(const Filter& filter) const { check_filter(filter, index->vertex_count()); }

Point RegionSearcher::State::begin(const Start& start, const Filter& filter) {
  walls = LaneFilter(*index, filter.walls);
  ignored = LaneFilter(*index, filter.ignored);
  answer.clear();
  if (!start.center()) {
    const Point center = position_of(*index, start.vertex());
    flood.start(center, walls);
    flood.add_seed(slot(start.vertex()));
    return center;
  }
  const SpacePoint& p = *start.center();
  flood.start({p[0], p[1], p[2]}, walls);
  for (const VertexId seed : start.seeds()) flood.add_seed(slot(seed));
  return {p[0], p[1], p[2]};
}

std::optional<VertexId> RegionSearcher::State::vertex_of(const Start& start) const {
  if (!start.center()) return start.vertex();
  if (start.seeds().size() != 1) return std::nullopt;
  const SpacePoint& p = *start.center();
  const Point seed = position_of(*index, start.seeds().front());
  return seed.x == p[0] && seed.y == p[1] && seed.z == p[2] ? std::optional(start.seeds().front()) : std::nullopt;
}

NestedNeighborhoods& RegionSearcher::State::neighborhoods() {
  if (!nested_neighborhoods) nested_neighborhoods = std::make_unique<NestedNeighborhoods>(index, isa);
  return *nested_neighborhoods;
}

LaneMask RegionSearcher::State::without_ignored(const LeafSubset& subset) const {
  return subset.lanes & ~ignored.of(subset.leaf);  // mutant: ignored-vertices-are-found
}

void RegionSearcher::State::add_found() {
  for_each_found(0, [&](const LeafSubset& subset) { answer.add(subset); });
}

void RegionSearcher::State::write_ids_to(std::vector<VertexId>& out) const {
  const std::size_t size = answer.count();
  out.resize(size + kLeafCapacity);
  write_ids(answer, *index, *kernels, out.data());
  out.resize(size);
}

Point RegionSearcher::State::search(const Start& start, double radius, const Filter& filter) {
  check(start);
  check_radius(radius);
  check(filter);
  const Point center = begin(start, filter);
  flood.grow(radius);
  add_found();
  return center;
}

RegionSearcher::RegionSearcher(const Index& index)
    : state_(std::make_unique<State>(IndexAccess::share(index), best_isa())) {}
RegionSearcher::RegionSearcher(RegionSearcher&&) noexcept = default;
RegionSearcher& RegionSearcher::operator=(RegionSearcher&&) noexcept = default;
RegionSearcher::~RegionSearcher() = default;

void RegionSearcher::region(const Start& start, double radius, std::vector<VertexId>& out, const Filter& filter) {
  state_->search(start, radius, filter);
  state_->write_ids_to(out);
}

void RegionSearcher::region(const Start& start, double radius, std::vector<VertexId>& out,
                            std::vector<double>& distances, const Filter& filter) {
  const Point center = state_->search(start, radius, filter);
  // Before `out` changes: if this throws, neither has changed.
  distances.reserve(state_->answer.count());
  state_->write_ids_to(out);
  distances.resize(out.size());
  write_distances(state_->answer, *state_->index, center, distances.data());
}

std::size_t RegionSearcher::count(const Start& start, double radius, const Filter& filter) {
  state_->search(start, radius, filter);
  return state_->answer.count();
}

}  // namespace meshhood
