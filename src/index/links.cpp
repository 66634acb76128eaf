// SPDX-License-Identifier: MIT
#include "index/links.h"

#include <algorithm>
#include <bit>
#include <string>

#include "meshhood/error.h"

namespace meshhood {
namespace {

/// An edge that leaves a leaf as one number: the other leaf, the lane here, the lane there.
using Exit = std::uint64_t;

Exit make_exit(unsigned lane, std::uint32_t place) {
  const Exit leaf = place / kLeafCapacity;
  return (leaf * kLeafCapacity + lane) * kLeafCapacity + place % kLeafCapacity;
}

LeafId leaf_of(Exit exit) { return static_cast<LeafId>(exit / (kLeafCapacity * kLeafCapacity)); }

Crossing crossing_of(Exit exit) {
  return {static_cast<std::uint8_t>(exit / kLeafCapacity % kLeafCapacity),
          static_cast<std::uint8_t>(exit % kLeafCapacity)};
}

/// `exits` ascend, so those to one leaf come together.
void append_links(const std::vector<Exit>& exits, Links& out) {
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (i == 0 || leaf_of(exits[i]) != leaf_of(exits[i - 1])) {
      out.links.push_back({leaf_of(exits[i]), 0, static_cast<std::uint32_t>(out.crossings.size())});
    }
    const Crossing crossing = crossing_of(exits[i]);
    out.links.back().border |= Lanes{1} << crossing.mine;
    out.crossings.push_back(crossing);
  }
}

/// The links of the leaves `begin .. end - 1`, counted from the first of them. Their part of `adjacency` is filled.
Links link_leaves(const AdjacencyView& graph, const LeafPartition& leaves, std::size_t begin, std::size_t end,
                  std::vector<Lanes>& adjacency) {
  Links result;
  std::vector<Exit> exits;
  for (std::size_t leaf = begin; leaf < end; ++leaf) {
    exits.clear();
    const std::size_t first = leaves.leaf_begin[leaf];
    for (std::size_t v = first; v < leaves.leaf_begin[leaf + 1]; ++v) {
      for (const VertexId w : graph[leaves.permutation[v]]) {
        const std::uint32_t place = leaves.place[w];
        if (place / kLeafCapacity == leaf) {
          adjacency[v] |= Lanes{1} << place % kLeafCapacity;
        } else {
          exits.push_back(make_exit(static_cast<unsigned>(v - first), place));
        }
      }
    }
    std::sort(exits.begin(), exits.end());
    append_links(exits, result);
    result.link_end.push_back(static_cast<std::uint32_t>(result.links.size()));
  }
  return result;
}

/// Appends the links of the leaves that follow.
void append(const Links& next, Links& all) {
  const auto links = static_cast<std::uint32_t>(all.links.size());
  const auto crossings = static_cast<std::uint32_t>(all.crossings.size());
  for (const std::uint32_t end : next.link_end) all.link_end.push_back(links + end);
  for (const Link& link : next.links) all.links.push_back({link.leaf, link.border, crossings + link.first_crossing});
  all.crossings.insert(all.crossings.end(), next.crossings.begin(), next.crossings.end());
}

}  // namespace

Links make_links(const AdjacencyView& graph, const LeafPartition& leaves, Work& work) {
  constexpr std::size_t kGrain = 256;
  const std::size_t leaf_count = leaves.leaf_begin.size() - 1;
  Links result;
  result.adjacency.resize(leaves.permutation.size());
  std::vector<Links> runs((leaf_count + kGrain - 1) / kGrain);
  work.parallel_for(leaf_count, kGrain, [&](unsigned, std::size_t begin, std::size_t end) {
    runs[begin / kGrain] = link_leaves(graph, leaves, begin, end, result.adjacency);
  });
  result.crossings.reserve(graph.neighbors.size() / 3);
  for (const Links& run : runs) append(run, result);
  result.links.push_back({0, 0, static_cast<std::uint32_t>(result.crossings.size())});
  return result;
}

bool is_connected(const Lanes* adjacency, unsigned size) {
  if (size == 0) return true;
  Lanes reached = 1;
  for (Lanes todo = 1; todo != 0;) {
    const Lanes added = adjacency[std::countr_zero(todo)] & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached == first_lanes(size);
}

}  // namespace meshhood
