// SPDX-License-Identifier: MIT
#include "exact/search/vertex_bfs.h"

#include <algorithm>

#include "base/reference_access.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns whether no vertex has a neighbor, as in a set of points.
bool has_no_edges(const IndexView& index) {
  const auto is_zero = [](LaneMask neighbors) { return neighbors == 0; };
  return index.links.size() == 1 && std::ranges::all_of(index.adjacency, is_zero);
}

}  // namespace

bool is_unlike_a_surface(const IndexView& index) {
  // On a surface, a leaf of 30 vertices has six links of eight edges: a link for every five vertices. Chosen: the
  // bounds are between those and the graphs of bench/odd_graphs, which have a link for every four vertices or fewer, of
  // hardly more than one edge.
  constexpr double kMostLinks = 0.255;  // for each vertex
  constexpr double kFewestEdges = 2;    // of each link
  const auto links = static_cast<double>(index.links.size() - 1);
  const auto cross_edges = static_cast<double>(index.cross_edges.size() - kLeafCapacity);
  return links > kMostLinks * static_cast<double>(index.vertex_count()) && cross_edges < kFewestEdges * links;
}

bool is_odd(const IndexView& index) {
  if (index.vertex_count() == 0) return false;
  return is_unlike_a_surface(index) || has_no_edges(index) || may_squares_underflow(index.frame);
}

void VertexBfs::make_searcher() {
  const PositionsView positions =
      std::visit([&](auto xyz) { return PositionsView(xyz.first(3 * index_->vertex_count())); }, index_->positions);
  found_.emplace(index_->vertex_count());
  searcher_.emplace(ReferenceAccess::make({positions, graph_->edges_of(*index_)->view()}));
  for (std::size_t leaf = 0; leaf < index_->walls.size(); ++leaf) {
    for_each_lane(index_->walls[leaf], [&](unsigned lane) {
      ReferenceAccess::remove(*searcher_, static_cast<VertexId>(index_->leaf_begin[leaf] + lane));
    });
  }
}

void VertexBfs::run(VertexId v, double squared_radius, VertexSet& answer) {
  if (!searcher_) make_searcher();
  const auto vertex = static_cast<VertexId>(index_->place(v));
  found_->clear();  // a search that ran out of memory has left some vertices
  for (const VertexId w : ReferenceAccess::search(*searcher_, vertex, squared_radius)) found_->insert(w);
  found_->take_words([&](std::size_t first, std::uint64_t bits) {
    for (std::size_t begin = first; bits != 0; begin += kLeafCapacity, bits >>= kLeafCapacity) {
      const std::size_t end = std::min(begin + kLeafCapacity, index_->vertex_count());
      answer.add_lanes(VertexRange{static_cast<VertexId>(begin), static_cast<VertexId>(end)},
                       static_cast<LaneMask>(bits));
    }
  });
}

}  // namespace meshhood::inline v0_1
