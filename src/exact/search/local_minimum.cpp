// SPDX-License-Identifier: MIT
#include "exact/search/local_minimum.h"

#include "base/distance.h"

namespace meshhood {
namespace {

bool has_nearer_neighbor_outside(const IndexView& index, const LocalMinimum& vertex, const Point& centre) {
  for (const Link& link : index.links_of(vertex.leaf)) {
    if ((link.boundary >> vertex.lane & 1U) == 0) continue;
    for (const CrossEdge& edge : index.cross_edges_of(link)) {
      if (edge.from != vertex.lane) continue;  // mutant: cross-edges-of-every-lane
      // mutant: tied-neighbor-taken-as-nearer
      if (squared_distance(index.position(link.leaf, edge.to), centre) < vertex.square) return true;
    }
  }
  return false;
}

}  // namespace

void append_local_minima(const IndexView& index, const Kernels& kernels, LeafId leaf, std::uint32_t slot,
                         const LeafBall& ball, std::vector<LocalMinimum>& out) {
  const Leaf& record = index.leaves[leaf];
  const LaneMask inside = kernels.within(index.positions, record.first, record.size, ball);
  const LaneMask query_lane = leaf_of(slot) == leaf ? LaneMask{1} << lane_of(slot) : 0;
  for (LaneMask left = inside; left != 0;) {
    const bool is_one = record.connected && left == first_lanes(record.size);
    const LaneMask part = is_one ? left : kernels.reachable(&index.adjacency[record.first], left, left & -left);
    left &= ~part;
    if ((part & query_lane) != 0) continue;  // mutant: query-leaf-has-no-minimum
    const Nearest nearest = kernels.nearest(index.positions, record.first, part, ball);
    const LocalMinimum vertex{nearest.square, leaf, nearest.lane};
    if (!has_nearer_neighbor_outside(index, vertex, ball.centre)) out.push_back(vertex);
  }
}

}  // namespace meshhood
