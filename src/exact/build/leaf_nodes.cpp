// SPDX-License-Identifier: MIT
#include "exact/build/leaf_nodes.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace meshhood {

LeafMeasure::LeafMeasure(const IndexView& index) : index_(index), with_regions_(!may_squares_underflow(index.frame)) {}

void LeafMeasure::measure(LeafId leaf, NodeList& out, std::size_t at) {
  const std::size_t begin = index_.leaf_begin[leaf];
  const std::size_t size = index_.leaf_begin[leaf + std::size_t{1}] - begin;
  if (size == 0) return;
  points_.clear();
  for (std::size_t i = 0; i < size; ++i) points_.push_back(index_.in_frame(begin + i));
  out.bounds[at] = enclosing_sphere(points_);
  out.regions[at] = kUnboundedRegion;
  if (!with_regions_) return;
  own_edges_.clear();
  edges_.clear();
  gather_own_edges(begin, size);  // mutant: edges-within-leaf-ignored
  gather_edges_out(leaf);         // mutant: edges-to-other-leaves-ignored
  out.regions[at] = leaf_minimum_region(points_, 0, size, own_edges_, edges_, center_of(out.bounds[at]));
}

void LeafMeasure::gather_own_edges(std::size_t begin, std::size_t size) {
  for (std::uint32_t lane = 0; lane < size; ++lane) {
    const LaneMask later = index_.adjacency[begin + lane] & ~first_lanes(lane + 1);
    for_each_lane(later, [&](unsigned to) { own_edges_.push_back({lane, to}); });
  }
}

void LeafMeasure::gather_edges_out(LeafId leaf) {
  for (const Link& link : index_.links_of(leaf)) {
    const std::size_t other = index_.leaf_begin[link.leaf];
    for (const CrossEdge& edge : index_.cross_edges_of(link)) {
      edges_.push_back({edge.from, static_cast<std::uint32_t>(points_.size())});
      points_.push_back(index_.in_frame(other + edge.to));
    }
  }
}

NodeList make_leaf_nodes(const IndexView& index, TaskContext& task) {
  // Enough leaves for the cost of starting a thread.
  constexpr std::size_t kGrain = 64;
  NodeList result(index.leaf_count());
  task.parallel_for(result.bounds.size(), kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    LeafMeasure measure(index);
    for (std::size_t leaf = begin; leaf < end; ++leaf) measure.measure(static_cast<LeafId>(leaf), result, leaf);
  });
  return result;
}

}  // namespace meshhood
