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

}  // namespace

Links make_links(const AdjacencyView& adjacency, const LeafPartition& leaves) {
  Links result;
  result.adjacency.resize(leaves.permutation.size());
  result.crossings.reserve(adjacency.neighbors.size() / 3);
  std::vector<Exit> exits;
  for (LeafId leaf = 0; leaf + 1 < leaves.leaf_begin.size(); ++leaf) {
    exits.clear();
    const std::size_t begin = leaves.leaf_begin[leaf];
    for (std::size_t v = begin; v < leaves.leaf_begin[leaf + 1]; ++v) {
      for (const VertexId w : adjacency[leaves.permutation[v]]) {
        const std::uint32_t place = leaves.place[w];
        if (place / kLeafCapacity == leaf) {
          result.adjacency[v] |= Lanes{1} << place % kLeafCapacity;
        } else {
          exits.push_back(make_exit(static_cast<unsigned>(v - begin), place));
        }
      }
    }
    std::sort(exits.begin(), exits.end());
    append_links(exits, result);
    result.link_end.push_back(static_cast<std::uint32_t>(result.links.size()));
  }
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
