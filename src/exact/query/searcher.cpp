// SPDX-License-Identifier: MIT
// A searcher checks the arguments of its calls, and sets their results. `make_queries` makes what answers them.
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/search.h"

#include "exact/index_access.h"
#include "exact/query/arguments.h"
#include "exact/query/single_queries.h"
#include "exact/query/straight_queries.h"
#include "exact/search/vertex_bfs.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

std::unique_ptr<SingleQueries> make_queries(BoundIndex index, std::shared_ptr<KeptGraph> graph, Metric metric,
                                            Isa isa) {
  if (is_along_edges(metric)) return make_length_queries(std::move(index), std::move(graph), metric, isa);
  if (metric == Metric::Space) return make_space_queries(std::move(index), std::move(graph), isa);
  return std::make_unique<StraightQueries>(std::move(index), std::move(graph), isa);
}

void prepare_searches(const Index& index, Metric metric) {
  const IndexView& view = IndexAccess::view(index);
  KeptGraph& graph = *IndexAccess::share_graph(index);
  const bool is_by_vertex =
      metric == Metric::Rings ? is_unlike_a_surface(view) : metric == Metric::Straight && is_odd(view);
  if (is_by_vertex) static_cast<void>(graph.edges_of(view));
  if (metric == Metric::Path) static_cast<void>(graph.paths_of(view));
}

void SingleQueries::check(const Start& start, std::string_view where) const {
  index.check_current();
  check_start(start, index->vertex_count(), where);
  if (metric != Metric::Rings || !start.center()) return;
  raise(ErrorCode::InvalidOption,
        std::string(where) + "start: expected a vertex by rings, because a point has no edges");
}

void SingleQueries::rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept) {
  index = std::move(bound);
  graph = std::move(kept);
}

Point SingleQueries::center_of(const Start& start) const {
  if (!start.center()) return index->position_of(start.vertex());
  const auto& [x, y, z] = *start.center();
  return {x, y, z};
}

void SingleQueries::list(const Start& start, double radius, std::vector<VertexId>& out,
                         std::vector<double>* distances) {
  const VertexSet& found = search(start, radius);
  const Point center = distances != nullptr ? center_of(start) : Point{};
  if (distances != nullptr) distances->reserve(found.count());  // before `out` changes
  replace_ids(found, *index, *kernels, out);
  if (distances == nullptr) return;
  distances->resize(out.size());
  write_distances(found, *index, center, distances->data());
}

void SingleQueries::nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& ids,
                           std::vector<std::size_t>& sizes) {
  VertexSet before(*index);
  VertexSet ring(*index);
  for (const double radius : radii) {
    VertexSet& found = search(start, radius);
    ring.assign_difference(found, before);
    append_ids(ring, *index, *kernels, ids);
    sizes.push_back(ids.size());
    std::swap(before, found);
  }
}

Searcher::Searcher(const Index& index, Metric metric)
    : metric_(metric), queries_(make_queries(BoundIndex(index), IndexAccess::share_graph(index), metric, best_isa())) {}

void Searcher::rebind(const Index& index) {
  if (queries_ && queries_->index.is_of(index)) {
    queries_->rebind(BoundIndex(index), IndexAccess::share_graph(index));
  } else {
    *this = Searcher(index, metric_);
  }
}

std::size_t Searcher::vertex_count() const { return queries_->index->vertex_count(); }

std::span<const VertexId> Searcher::permutation() const& {
  const std::span<const VertexId> padded = queries_->index->permutation;
  return padded.empty() ? padded : padded.first(vertex_count());
}

void Searcher::neighborhood(const Start& start, Radius radius, std::vector<VertexId>& out) {
  queries_->list(start, radius, out, nullptr);
}

void Searcher::neighborhood(const Start& start, Radius radius, std::vector<VertexId>& out,
                            std::vector<double>& distances) {
  queries_->list(start, radius, out, &distances);
}

std::span<const VertexRange> Searcher::ranges(const Start& start, Radius radius) & {
  return queries_->search(start, radius).ranges();
}

std::size_t Searcher::count(const Start& start, Radius radius) { return queries_->count(start, radius); }

bool Searcher::has_seed(const Start& start, Radius radius) const {
  queries_->check(start);
  check_radius(radius);
  if (!start.center() || metric_ == Metric::Space) return true;
  const SearchBall ball(queries_->center_of(start), radius);
  return std::ranges::any_of(start.seeds(),
                             [&](VertexId seed) { return ball.contains(queries_->index->position_of(seed)); });
}

// The results may be memory that the starts borrow, so they change last.

void Searcher::stroke(std::span<const Dab> dabs, std::vector<VertexId>& out) {
  SingleQueries& queries = *queries_;
  for (std::size_t i = 0; i < dabs.size(); ++i) {
    const std::string where = "dab " + std::to_string(i) + ": ";
    queries.check(dabs[i].start, where);
    check_radius(dabs[i].radius, where);
  }
  std::vector<LeafSubset> found;
  for (const Dab& dab : dabs) queries.collect(dab.start, dab.radius, found);
  queries.answer.assign(found);
  replace_ids(queries.answer, *queries.index, *queries.kernels, out);
}

void Searcher::nested(const Start& start, std::span<const double> radii, std::vector<VertexId>& out,
                      std::vector<std::size_t>& counts) {
  queries_->check(start);
  check_ascending(radii);
  std::vector<VertexId> ids;
  std::vector<std::size_t> sizes;
  sizes.reserve(radii.size());
  if (!radii.empty()) queries_->nested(start, radii, ids, sizes);
  out = std::move(ids);
  counts = std::move(sizes);
}

bool Searcher::contains(const Start& start, Vertex w, Radius radius) {
  queries_->check(start);
  check_vertex(w, vertex_count(), "vertex");
  check_radius(radius);
  return queries_->contains(start, w, radius);
}

double Searcher::connecting_radius(const Start& start, Vertex w) {
  queries_->check(start);
  check_vertex(w, vertex_count(), "vertex");
  return queries_->connecting_radius(start, w);
}

void Searcher::nearest_connected(const Start& start, std::size_t k, std::vector<VertexId>& out,
                                 std::vector<double>& radii) {
  queries_->check(start);
  check_k(k);
  std::vector<VertexId> ids;
  std::vector<double> found_radii;
  queries_->nearest(start, k, ids, found_radii);
  out = std::move(ids);
  radii = std::move(found_radii);
}

StraightSearch& SearcherAccess::state(Searcher& searcher) {
  return static_cast<StraightQueries&>(*searcher.queries_).straight_search();
}

void SearcherAccess::set_isa(Searcher& searcher, Isa isa) {
  const SingleQueries& queries = *searcher.queries_;
  searcher.queries_ = make_queries(queries.index, queries.graph, queries.metric, isa);
}

}  // namespace meshhood::inline v0_1
