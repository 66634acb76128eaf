// SPDX-License-Identifier: MIT
#include "search/local_minimum.h"

#include "distance.h"

namespace meshhood {
namespace {

bool has_nearer_neighbor_outside(const IndexStorage& index, const LocalMinimum& vertex, const Point& centre) {
  for (std::uint32_t i = index.leaves[vertex.leaf].first_link; i < index.leaves[vertex.leaf + 1].first_link; ++i) {
    const Link& link = index.links[i];
    if ((link.border >> vertex.lane & 1U) == 0) continue;
    for (std::uint32_t k = link.first_crossing; k < index.links[i + 1].first_crossing; ++k) {
      const Crossing& crossing = index.crossings[k];
      if (crossing.mine != vertex.lane) continue;
      if (squared_distance(index.position(link.leaf, crossing.other), centre) < vertex.square) return true;
    }
  }
  return false;
}

}  // namespace

void append_local_minima(const IndexStorage& index, const Kernels& kernels, LeafId leaf, std::uint32_t place,
                         const LeafBall& ball, std::vector<LocalMinimum>& out) {
  const Leaf& record = index.leaves[leaf];
  const Lanes inside = kernels.within(index.positions, record.first, record.size, ball);
  const Lanes query_lane = place / kLeafCapacity == leaf ? Lanes{1} << place % kLeafCapacity : 0;
  for (Lanes left = inside; left != 0;) {
    const bool is_one = record.connected && left == first_lanes(record.size);
    const Lanes part = is_one ? left : kernels.spread(&index.adjacency[record.first], left, left & -left);
    left &= ~part;
    if ((part & query_lane) != 0) continue;
    const Nearest nearest = kernels.nearest(index.positions, record.first, part, ball);
    const LocalMinimum vertex{nearest.square, leaf, nearest.lane};
    if (!has_nearer_neighbor_outside(index, vertex, ball.centre)) out.push_back(vertex);
  }
}

}  // namespace meshhood
