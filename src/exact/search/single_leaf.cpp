// SPDX-License-Identifier: MIT
#include "exact/search/single_leaf.h"

#include "base/distance.h"

namespace meshhood {

LaneMask SingleLeaf::find(const Query& query) const {
  const Leaf& leaf = index_->leaves[query.leaf()];
  const LaneMask inside = kernels_->within(index_->positions, leaf.first, leaf.size, query.ball);
  const LaneMask found = kernels_->reachable(&index_->adjacency[leaf.first], inside, query.lane());
  return leads_out(query, found) ? 0 : found;  // mutant: answer-ends-at-the-leaf
}

/// Whether an edge leads from the vertices found to a vertex of the ball in another leaf.
bool SingleLeaf::leads_out(const Query& query, LaneMask found) const {
  for (const Link& link : index_->links_of(query.leaf())) {
    const LaneMask from = link.boundary & found;
    if (from == 0) continue;
    const LaneMask met = kernels_->cross_edges(index_->cross_edges_of(link), from);
    if (has_vertex_in_ball(link.leaf, met, query.ball)) return true;
  }
  return false;
}

/// Vertex by vertex, because few vertices of a leaf are met.
bool SingleLeaf::has_vertex_in_ball(LeafId leaf, LaneMask lanes, const LeafBall& ball) const {
  bool has = false;
  for_each_lane(lanes, [&](unsigned lane) {
    // mutant: ball-of-a-leaf-without-boundary
    has = has || squared_distance(index_->position(leaf, lane), ball.center) <= ball.squared_radius;
  });
  return has;
}

}  // namespace meshhood
