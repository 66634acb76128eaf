// SPDX-License-Identifier: MIT
#include "exact/build/leaf_nodes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "exact/build/minimum_region.h"
#include "exact/layout.h"

namespace meshhood {
namespace {

/// Computes the nodes of leaves one after the other, with one list of edges for all.
class LeafMeasure {
 public:
  LeafMeasure(std::span<const VertexId> leaf_begin, const Links& links, std::span<const Point> points,
              bool with_regions)
      : leaf_begin_(leaf_begin), links_(links), points_(points), with_regions_(with_regions) {}

  void measure(std::size_t leaf, NodeList& out) {
    const std::size_t begin = leaf_begin_[leaf];
    const std::size_t size = leaf_begin_[leaf + 1] - begin;
    out.bounds[leaf] = enclosing_sphere(points_.subspan(begin, size));
    out.regions[leaf] = kUnboundedRegion;
    if (!with_regions_) return;
    edges_.clear();
    gather_edges_within(begin, size);  // mutant: edges-within-leaf-ignored
    gather_edges_out(leaf);            // mutant: edges-to-other-leaves-ignored
    out.regions[leaf] = leaf_minimum_region(points_, begin, size, edges_, centre_of(out.bounds[leaf]));
  }

 private:
  void gather_edges_within(std::size_t begin, std::size_t size) {
    for (std::uint32_t lane = 0; lane < size; ++lane) {
      for (LaneMask left = links_.adjacency[begin + lane]; left != 0; left &= left - 1) {
        edges_.push_back(
            {lane, static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(std::countr_zero(left))});
      }
    }
  }

  void gather_edges_out(std::size_t leaf) {
    for (const Link& link : links_.links_of(leaf)) {
      const std::uint32_t other = leaf_begin_[link.leaf];
      for (const CrossEdge& edge : links_.cross_edges_of(link)) edges_.push_back({edge.from, other + edge.to});
    }
  }

  std::span<const VertexId> leaf_begin_;
  const Links& links_;
  std::span<const Point> points_;
  bool with_regions_;
  std::vector<LeafEdge> edges_;
};

}  // namespace

NodeList make_leaf_nodes(std::span<const VertexId> leaf_begin, const Links& links, std::span<const Point> points,
                         bool with_regions, TaskContext& task) {
  // Enough leaves to be worth a thread's while.
  constexpr std::size_t kGrain = 64;
  NodeList result(leaf_begin.size() - 1);
  task.parallel_for(result.bounds.size(), kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    LeafMeasure measure(leaf_begin, links, points, with_regions);
    for (std::size_t leaf = begin; leaf < end; ++leaf) measure.measure(leaf, result);
  });
  return result;
}

}  // namespace meshhood
