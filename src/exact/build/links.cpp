// SPDX-License-Identifier: MIT
#include "exact/build/links.h"

#include <algorithm>

#include "exact/lane_search.h"

namespace meshhood {
namespace {

/// An edge that leaves a leaf as one number, which orders edges by the other leaf, then the lane in this leaf, then the
/// lane in the other.
using Exit = std::uint64_t;

Exit make_exit(unsigned lane, std::uint32_t slot) {
  const Exit leaf = leaf_of(slot);
  return (leaf * kLeafCapacity + lane) * kLeafCapacity + lane_of(slot);
}

LeafId target_leaf(Exit exit) { return static_cast<LeafId>(exit / (Exit{kLeafCapacity} * kLeafCapacity)); }

CrossEdge cross_edge_of(Exit exit) {
  return {static_cast<std::uint8_t>(exit / kLeafCapacity % kLeafCapacity),
          static_cast<std::uint8_t>(exit % kLeafCapacity)};
}

/// `exits` are in ascending order, so those to one leaf are consecutive.
void append_links(const std::vector<Exit>& exits, Links& out) {
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (i == 0 || target_leaf(exits[i]) != target_leaf(exits[i - 1])) {
      out.links.push_back({target_leaf(exits[i]), 0, static_cast<std::uint32_t>(out.cross_edges.size())});
    }
    const CrossEdge cross_edge = cross_edge_of(exits[i]);
    out.links.back().boundary |= LaneMask{1} << cross_edge.from;
    out.cross_edges.push_back(cross_edge);
  }
}

/// The links of the leaves `begin .. end - 1`, numbered from 0. Fills their part of `adjacency`.
Links link_leaves(const AdjacencyView& graph, const LeafPartition& leaves, std::size_t begin, std::size_t end,
                  std::vector<LaneMask>& adjacency) {
  Links result;
  std::vector<Exit> exits;
  for (std::size_t leaf = begin; leaf < end; ++leaf) {
    exits.clear();
    const std::size_t first = leaves.leaf_begin[leaf];
    for (std::size_t v = first; v < leaves.leaf_begin[leaf + 1]; ++v) {
      for (const VertexId w : graph[leaves.permutation[v]]) {
        const std::uint32_t slot = leaves.slot[w];
        if (leaf_of(slot) == leaf) {
          adjacency[v] |= LaneMask{1} << lane_of(slot);
        } else {
          exits.push_back(make_exit(static_cast<unsigned>(v - first), slot));
        }
      }
    }
    std::sort(exits.begin(), exits.end());
    append_links(exits, result);
    result.link_end.push_back(static_cast<std::uint32_t>(result.links.size()));
  }
  return result;
}

/// Appends the links of the leaves after those in `all`.
void append(const Links& next, Links& all) {
  const auto links = static_cast<std::uint32_t>(all.links.size());
  const auto cross_edges = static_cast<std::uint32_t>(all.cross_edges.size());
  for (const std::uint32_t end : next.link_end) all.link_end.push_back(links + end);
  for (const Link& link : next.links) {
    all.links.push_back({link.leaf, link.boundary, cross_edges + link.first_cross_edge});
  }
  all.cross_edges.insert(all.cross_edges.end(), next.cross_edges.begin(), next.cross_edges.end());
}

}  // namespace

Links make_links(const AdjacencyView& graph, const LeafPartition& leaves, TaskContext& task) {
  constexpr std::size_t kGrain = 256;
  const std::size_t leaf_count = leaves.leaf_begin.size() - 1;
  Links result;
  result.adjacency.resize(leaves.permutation.size());
  std::vector<Links> runs((leaf_count + kGrain - 1) / kGrain);
  task.parallel_for(leaf_count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    runs[begin / kGrain] = link_leaves(graph, leaves, begin, end, result.adjacency);
  });
  result.cross_edges.reserve(graph.neighbors.size() / 3);
  for (const Links& run : runs) append(run, result);
  result.links.push_back({0, 0, static_cast<std::uint32_t>(result.cross_edges.size())});
  return result;
}

bool is_connected(const LaneMask* adjacency, unsigned size) {
  return size == 0 || reachable_lanes(adjacency, 1) == first_lanes(size);
}

}  // namespace meshhood
