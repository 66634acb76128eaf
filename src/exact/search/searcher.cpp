// SPDX-License-Identifier: MIT
#include "meshhood/search.h"

#include "base/distance.h"
#include "exact/index_access.h"
#include "exact/search/output.h"
#include "exact/search/searcher_state.h"

namespace meshhood {

Point Searcher::State::search(VertexId v, double radius) {
  check_query(v, index->vertex_count(), radius);
  const std::uint32_t slot = index->slot[v];
  // All that the leaf has, at once: it would come piece by piece, each where it is first looked at.
  walk.fetch_leaf(index->leaves[leaf_of(slot)]);
  const Point centre = index->position(leaf_of(slot), lane_of(slot));
  if (radius != bounds.radius) bounds = RadiusBounds(index->frame, radius);
  const LeafBall ball(centre, bounds.leaf);
  const TreeBall tree_ball(index->frame.round(centre), bounds.tree);
  answer.clear();
  by_ball_search = ball_search.run(slot, ball, tree_ball, walk, answer);
  if (!by_ball_search) leaf_bfs.run(slot, ball, tree_ball, walk, answer);
  return centre;
}

void Searcher::State::refill(std::vector<VertexId>& out) const {
  const std::size_t size = meshhood::count(answer);
  out.resize(size + kLeafCapacity);
  write_ids(answer, *index, *kernels, out.data());
  out.resize(size);
}

Searcher::Searcher(const Index& index) : state_(std::make_unique<State>(IndexAccess::view(index), best_isa())) {}
Searcher::Searcher(Searcher&&) noexcept = default;
Searcher& Searcher::operator=(Searcher&&) noexcept = default;
Searcher::~Searcher() = default;

std::size_t Searcher::vertex_count() const { return state_->index->vertex_count(); }

std::span<const VertexId> Searcher::permutation() const {
  const std::span<const VertexId> padded = state_->index->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  state_->search(v, radius);
  state_->refill(out);
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  const Point centre = state_->search(v, radius);
  // First, for if there is no memory, neither may have changed.
  distances.reserve(meshhood::count(state_->answer));
  state_->refill(out);
  distances.resize(out.size());
  write_distances(state_->answer, *state_->index, centre, distances.data());
}

std::span<const VertexRange> Searcher::ranges(VertexId v, double radius) {
  state_->search(v, radius);
  append_subsets_as_runs(*state_->index, state_->answer);
  return state_->answer.runs;
}

std::size_t Searcher::count(VertexId v, double radius) {
  state_->search(v, radius);
  return meshhood::count(state_->answer);
}

}  // namespace meshhood
