// SPDX-License-Identifier: MIT
// Exact queries. The ball around the query vertex falls into components of the mesh. The answer is the ball without the
// components that do not hold the query vertex. Each of those has a vertex that is nearest to the query vertex, and
// that is a local minimum of the distance among its neighbours. So a search finds all of them from the local minima in
// the ball, which the tree bounds (see MinimumRegion). Where there is no other component, as on most surfaces, that
// costs about the leaves at the surface of the ball.
//
// Where the ball is small, or much of it does not belong to the answer, a breadth-first search over leaves is faster;
// and where the graph is unlike a surface, one over vertices.
#include "meshhood/search.h"

#include "base/distance.h"
#include "exact/index_access.h"
#include "exact/search/output.h"
#include "exact/search/searcher_state.h"

namespace meshhood {

Point Searcher::State::search(VertexId v, double radius) {
  check_query(v, index->vertex_count(), radius);
  traversal.prefetch_leaf(index->leaves[leaf_of(index->slot[v])]);
  if (radius != bounds.radius) bounds = RadiusBounds(index->frame, radius);
  const Query query(*index, v, bounds);
  const bool is_small = limits.is_small(query, *index);
  answer.clear();
  was_proved = !is_small && prove(query);
  if (!was_proved) leaf_bfs.run(query, is_small, traversal, answer);
  return query.centre();
}

/// Returns false, with an empty answer, if the breadth-first search is probably faster.
bool Searcher::State::prove(const Query& query) {
  if (limits.enabled && !failures.should_try(query)) return false;
  const bool proved = subtract_other_components(query);
  failures.record(query, proved);
  if (!proved) answer.clear();  // mutant: failed-search-leaves-answer
  return proved;
}

bool Searcher::State::subtract_other_components(const Query& query) {
  if (!descent.run(query, limits, answer)) return false;
  const std::size_t leaves = answer.count() / kLeafCapacity + descent.intersecting_leaves().size();
  if (descent.candidate_leaves().size() > limits.most_candidates(leaves)) return false;
  find_local_minima(*index, *kernels, descent.candidate_leaves(), query, minima);
  if (!other_components.find(query, minima, limits.most_visited(leaves), traversal)) return false;
  add_intersecting_leaves(query);
  answer.subtract(other_components.found());
  return true;
}

void Searcher::State::add_intersecting_leaves(const Query& query) {
  constexpr std::size_t kPrefetchDistance = 4;
  const std::span<const LeafId> leaves = descent.intersecting_leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (i + kPrefetchDistance < leaves.size())
      prefetch_positions(*index, index->leaf_begin[leaves[i + kPrefetchDistance]], kLeafCapacity);
    const VertexId first = index->leaf_begin[leaves[i]];
    const std::size_t size = index->leaf_begin[leaves[i] + 1] - first;
    const LaneMask lanes = kernels->within(index->positions, first, size, query.ball);
    if (lanes != 0) answer.add(LeafSubset{leaves[i], lanes});
  }
}

void Searcher::State::write_answer(std::vector<VertexId>& out) const {
  const std::size_t size = answer.count();
  out.resize(size + kLeafCapacity);
  write_ids(answer, *index, *kernels, out.data());
  out.resize(size);
}

Searcher::Searcher(const Index& index) : state_(std::make_unique<State>(IndexAccess::share(index), best_isa())) {
  if (is_unlike_a_surface(*state_->index)) state_->vertex_bfs.emplace(index);
}
Searcher::Searcher(Searcher&&) noexcept = default;
Searcher& Searcher::operator=(Searcher&&) noexcept = default;
Searcher::~Searcher() = default;

std::size_t Searcher::vertex_count() const { return state_->index->vertex_count(); }

std::span<const VertexId> Searcher::permutation() const {
  const std::span<const VertexId> padded = state_->index->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out) {
  if (state_->vertex_bfs) return state_->vertex_bfs->searcher().neighborhood(v, radius, out);
  state_->search(v, radius);
  state_->write_answer(out);
}

void Searcher::neighborhood(VertexId v, double radius, std::vector<VertexId>& out, std::vector<double>& distances) {
  if (state_->vertex_bfs) return state_->vertex_bfs->searcher().neighborhood(v, radius, out, distances);
  const Point centre = state_->search(v, radius);
  // Before `out` changes: if this throws, neither has changed.
  distances.reserve(state_->answer.count());
  state_->write_answer(out);
  distances.resize(out.size());
  write_distances(state_->answer, *state_->index, centre, distances.data());
}

std::span<const VertexRange> Searcher::ranges(VertexId v, double radius) {
  if (state_->vertex_bfs) return state_->vertex_bfs->ranges(v, radius);
  state_->search(v, radius);
  return state_->answer.all_as_runs();
}

std::size_t Searcher::count(VertexId v, double radius) {
  if (state_->vertex_bfs) return state_->vertex_bfs->searcher().count(v, radius);
  state_->search(v, radius);
  return state_->answer.count();
}

}  // namespace meshhood
