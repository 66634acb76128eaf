// SPDX-License-Identifier: MIT
#include "exact/search/vertex_bfs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/limits.h"
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

VertexBfs::VertexBfs(const IndexView& index) : index_(&index) {
  constexpr double kMeanLeafRadii = 1.8;  // chosen; such a ball of a plane has about 100 vertices
  if (index.vertex_count() == 0) return;
  if (is_unlike_a_surface(index) || may_squares_underflow(index.frame)) {
    answer_all();
  } else if (index.vertex_count() <= kSmallMesh) {
    few_ = kFewVertices;
    most_ = kMostVertices;
    largest_radius_ = kMeanLeafRadii * index.tree[0].mean_radius / index.frame.scale;
    learns_ = true;
    balls_before_ = index.vertex_count() / kVerticesPerBall;
  }
}

/// Returns false as long as the copy of the graph would probably take longer than it saves.
bool VertexBfs::make_searcher() {
  if (balls_before_ > 0) {  // mutant: copy-made-too-soon
    --balls_before_;
    return false;
  }
  searcher_.emplace(index_->graph->of(*index_).view());
  return true;
}

void VertexBfs::take_for_large(double radius) {
  largest_radius_ = std::nextafter(radius, -1.0);  // mutant: large-balls-tried-again
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

void VertexBfs::answer_all() {
  few_ = most_ = kAll;
  largest_radius_ = kInfinity;
  learns_ = false;
  balls_before_ = 0;
}

void VertexBfs::answer_none() {
  largest_radius_ = -1;
  learns_ = false;
}

}  // namespace meshhood
