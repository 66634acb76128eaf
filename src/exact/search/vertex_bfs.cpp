// SPDX-License-Identifier: MIT
#include "exact/search/vertex_bfs.h"

#include <algorithm>

#include "exact/index_access.h"
#include "exact/shared_graph.h"

namespace meshhood {

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

VertexBfs::VertexBfs(const Index& index)
    : index_(&IndexAccess::view(index)), searcher_(index_->graph->of(index).view()) {}

std::span<const VertexRange> VertexBfs::ranges(VertexId v, double radius) {
  searcher_.neighborhood(v, radius, vertices_);
  for (VertexId& vertex : vertices_) {
    const std::uint32_t slot = index_->slot[vertex];
    vertex = static_cast<VertexId>(index_->leaf_begin[leaf_of(slot)] + lane_of(slot));
  }
  std::sort(vertices_.begin(), vertices_.end());
  ranges_.clear();
  for (const VertexId vertex : vertices_) {
    if (ranges_.empty() || ranges_.back().end != vertex) ranges_.push_back({vertex, vertex});  // mutant: run-never-ends
    ranges_.back().end = static_cast<VertexId>(vertex + 1);
  }
  return ranges_;
}

}  // namespace meshhood
