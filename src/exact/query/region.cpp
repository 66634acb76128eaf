// SPDX-License-Identifier: MIT
// The region of one start and one radius: the neighborhood of a vertex, or else a flood that grows once. And strokes.
#include "meshhood/region.h"

#include <algorithm>
#include <string>
#include <utility>

#include "exact/bound_index.h"
#include "exact/query/arguments.h"
#include "exact/query/region_state.h"
#include "exact/vertex_set.h"
#include "shared/distance.h"

namespace meshhood {

void RegionSearcher::State::check(const Start& start, std::string_view where) const {
  index.check_current();
  check_start(start, index->vertex_count(), where);
}

Point RegionSearcher::State::begin(const Start& start) {
  const Point center = center_of(start);
  flood.start(center);
  for (const VertexId seed : start.seeds()) flood.add_seed(slot(seed));
  return center;
}

Point RegionSearcher::State::center_of(const Start& start) const {
  if (!start.center()) return position_of(*index, start.vertex());
  const SpacePoint& p = *start.center();
  return {p[0], p[1], p[2]};
}

bool RegionSearcher::State::has_seed(const Start& start, double radius) const {
  if (!start.center() || !flood.reached().empty()) return true;
  const SpacePoint& p = *start.center();
  const SearchBall ball({p[0], p[1], p[2]}, radius);
  // A seed in the ball that the flood has not reached is a wall.
  const auto is_inside = [&](VertexId seed) { return ball.contains(position_of(*index, seed)); };
  return std::any_of(start.seeds().begin(), start.seeds().end(), is_inside);
}

SearcherAccess::State& RegionSearcher::State::searcher() {
  if (!neighborhoods) neighborhoods = std::make_unique<SearcherAccess::State>(index, graph, isa);
  return *neighborhoods;
}

void RegionSearcher::State::collect_found(std::size_t skip) {
  found.clear();
  for_each_found(skip, [&](const LeafSubset& subset) { found.push_back(subset); });
  answer.assign(found);
}

Point RegionSearcher::State::search(const Start& start, double radius) {
  check(start);
  check_radius(radius);
  if (is_neighborhood(start)) {
    searcher().search(start.vertex(), radius);
    std::swap(answer, searcher().answer);
    return center_of(start);
  }
  const Point center = begin(start);
  flood.grow(radius);
  collect_found();
  return center;
}

RegionSearcher::RegionSearcher(const Index& index)
    : state_(std::make_unique<State>(BoundIndex(index), IndexAccess::share_graph(index), best_isa())) {}

void RegionSearcher::rebind(const Index& index) {
  if (state_ && state_->index.is_of(index)) {
    state_->index = BoundIndex(index);
    state_->graph = IndexAccess::share_graph(index);
    if (state_->neighborhoods) state_->neighborhoods->rebind(state_->index, state_->graph);
  } else {
    *this = RegionSearcher(index);
  }
}

bool RegionSearcher::region(const Start& start, double radius, std::vector<VertexId>& out) {
  state_->search(start, radius);
  const bool has_seed = state_->has_seed(start, radius);  // before `out` changes, which may be the seeds
  replace_ids(state_->answer, *state_->index, *state_->kernels, out);
  return has_seed;
}

bool RegionSearcher::region(const Start& start, double radius, std::vector<VertexId>& out,
                            std::vector<double>& distances) {
  const Point center = state_->search(start, radius);
  const bool has_seed = state_->has_seed(start, radius);
  // Before `out` changes: if this throws, neither has changed.
  distances.reserve(state_->answer.count());
  replace_ids(state_->answer, *state_->index, *state_->kernels, out);
  distances.resize(out.size());
  write_distances(state_->answer, *state_->index, center, distances.data());
  return has_seed;
}

std::size_t RegionSearcher::count(const Start& start, double radius) {
  state_->search(start, radius);
  return state_->answer.count();
}

/// The union of the regions, one flood after the other.
bool RegionSearcher::stroke(std::span<const Dab> dabs, std::vector<VertexId>& out) {
  State& state = *state_;
  for (std::size_t i = 0; i < dabs.size(); ++i) {
    const std::string where = "dab " + std::to_string(i) + ": ";
    state.check(dabs[i].start, where);
    check_radius(dabs[i].radius, where);
  }
  std::vector<LeafSubset>& found = state.found;
  found.clear();
  bool all_have_seeds = true;
  for (const Dab& dab : dabs) {
    state.begin(dab.start);
    state.flood.grow(dab.radius);
    all_have_seeds = all_have_seeds && state.has_seed(dab.start, dab.radius);
    state.for_each_found(0, [&](const LeafSubset& subset) { found.push_back(subset); });
  }
  state.answer.assign(found);
  replace_ids(state.answer, *state.index, *state.kernels, out);
  return all_have_seeds;
}

}  // namespace meshhood
