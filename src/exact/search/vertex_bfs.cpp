// SPDX-License-Identifier: MIT
#include "exact/search/vertex_bfs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/distance.h"
#include "base/limits.h"
#include "exact/shared_graph.h"

namespace meshhood {
namespace {

/// Whether no vertex has a neighbor, as in a set of points.
bool has_no_edges(const IndexView& index) {
  const auto is_zero = [](LaneMask neighbors) { return neighbors == 0; };
  return index.links.size() == 1 && std::ranges::all_of(index.adjacency, is_zero);
}

}  // namespace

bool is_unlike_a_surface(const IndexView& index) {
  // On a surface, a leaf of 30 vertices has six links of eight edges: a link for every five vertices. Chosen: between
  // those and the graphs of bench/odd_graphs, which have a link for every four vertices or fewer, of hardly more than
  // one edge.
  constexpr double kMostLinks = 0.255;  // for each vertex
  constexpr double kFewestEdges = 2;    // of each link
  const auto links = static_cast<double>(index.links.size() - 1);
  const auto cross_edges = static_cast<double>(index.cross_edges.size() - kLeafCapacity);
  // mutant: few-links-suffice, links-of-many-edges-suffice
  return links > kMostLinks * static_cast<double>(index.vertex_count()) && cross_edges < kFewestEdges * links;
}

bool is_numbered_by_rows(const AdjacencyView& graph) {
  std::size_t repeated = 0;
  for (VertexId v = 1; v < graph.size(); ++v) {
    const auto is_next = [](VertexId before, VertexId neighbor) { return neighbor == before + 1; };
    repeated += static_cast<std::size_t>(std::ranges::equal(graph[v - 1], graph[v], is_next));
  }
  return 2 * repeated > graph.size();  // mutant: any-order-is-by-rows
}

VertexBfs::VertexBfs(const IndexView& index) : index_(&index) {
  if (index.vertex_count() == 0) return;
  if (is_unlike_a_surface(index) || has_no_edges(index) || may_squares_underflow(index.frame)) {
    answer_all();
  } else if (index.vertex_count() <= kSmallMesh) {
    largest_radius_ = radius_of(kByRows.mean_leaf_radii);
    balls_before_ = index.vertex_count() / kVerticesPerBall;
  }
}

double VertexBfs::radius_of(double mean_leaf_radii) const {
  return mean_leaf_radii * index_->tree[0].mean_radius / index_->frame.scale;
}

void VertexBfs::make_searcher() { searcher_.emplace(index_->graph->of(*index_).view()); }

/// Checks the arguments of a query, and keeps what depends on the radius alone.
void VertexBfs::keep(VertexId v, double radius) {
  check_query(v, index_->vertex_count(), radius);
  radius_ = radius;
  squared_radius_ = squared_radius(radius);
}

std::span<const VertexId> VertexBfs::find_small(VertexId v, double radius) {
  if (v >= index_->vertex_count()) return {};  // the searches over leaves refuse it
  if (places_.empty() && !make_places()) return {};
  Place& place = place_of(v);
  if (!(radius <= place.largest_radius)) return {};
  prepare(v, radius);
  const std::span<const VertexId> found =
      ReferenceAccess::search_few(*searcher_, v, squared_radius_, kVerticesToTheStop * place.most_vertices);
  if (!is_small(place, radius, found.size())) {
    place.largest_radius = std::nextafter(radius, -1.0);  // mutant: large-balls-tried-again
  }
  return found;
}

/// Whether a search over leaves would probably have taken longer to find `size` vertices; 0 stands for too many. Of a
/// ball with many vertices, that is only known at about the radius of the answer that was found over leaves.
bool VertexBfs::is_small(const Place& place, double radius, std::size_t size) const {
  if (size <= speed_.vertices) return size > 0;
  return size <= place.most_vertices && 2 * radius > place.largest_radius;
}

/// Makes the copy of the graph. Returns false as long as that would probably take longer than it saves.
bool VertexBfs::make_places() {
  if (balls_before_ > 0) {  // mutant: copy-made-too-soon
    --balls_before_;
    return false;
  }
  if (!searcher_) make_searcher();
  speed_ = is_numbered_by_rows(index_->graph->of(*index_).view().adjacency) ? kByRows : kInAnyOrder;
  largest_radius_ = radius_of(speed_.mean_leaf_radii);
  places_.assign(index_->leaf_count(), {largest_radius_, speed_.vertices});
  return true;
}

void VertexBfs::record(VertexId v, double radius, std::size_t size, std::size_t leaf_visits) {
  if (places_.empty()) return;
  Place& place = place_of(v);
  const std::size_t most = std::min(kFewest + speed_.vertices_per_leaf * leaf_visits, kMostVertices);
  if (radius <= place.largest_radius || size > most) return;  // mutant: large-answer-taken-for-small
  place = {radius, std::max(static_cast<std::uint32_t>(most), speed_.vertices)};
  largest_radius_ = std::max(largest_radius_, radius);
}

void VertexBfs::measure(VertexId v, std::span<const VertexId> ids, std::vector<double>& out) const {
  ReferenceAccess::measure(*searcher_, v, ids, out);
}

std::span<const VertexRange> VertexBfs::ranges_of(std::span<const VertexId> ids) {
  in_index_order_.clear();
  for (const VertexId id : ids) {
    const std::uint32_t slot = index_->slot[id];
    in_index_order_.push_back(static_cast<VertexId>(index_->leaf_begin[leaf_of(slot)] + lane_of(slot)));
  }
  std::sort(in_index_order_.begin(), in_index_order_.end());
  ranges_.clear();
  for (const VertexId vertex : in_index_order_) {
    if (ranges_.empty() || ranges_.back().end != vertex) ranges_.push_back({vertex, vertex});  // mutant: run-never-ends
    ranges_.back().end = static_cast<VertexId>(vertex + 1);
  }
  return ranges_;
}

void VertexBfs::answer_all() { answers_all_ = true; }

void VertexBfs::answer_none() {
  answers_all_ = false;
  largest_radius_ = -1;
  places_.clear();
}

}  // namespace meshhood
