// SPDX-License-Identifier: MIT
// The outward search of the paper finds all that may be connected with the query vertex in the ball: whole nodes, and
// leaves at the surface of the ball (`Reach`). The step that the paper leaves out takes the component of the query
// vertex from that (`Component`). docs/design.md says why the result is exact.
//
// Small balls are searched leaf by leaf along the edges of the mesh, and odd graphs vertex by vertex: both are plain
// breadth-first searches.
#include "exact/search/straight_search.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "exact/neighbors.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

void StraightSearch::rebind(BoundIndex bound, std::shared_ptr<KeptGraph> kept) {
  index = std::move(bound);
  graph = std::move(kept);
  bounds = RadiusBounds(index->frame, 0);
  is_odd = meshhood::is_odd(*index);
  vertex_bfs = VertexBfs(*index, *graph);
}

void StraightSearch::search(VertexId v, double radius) {
  index.check_current();
  // A call for valid arguments would take a tenth of the shortest queries.
  if (v >= index->vertex_count() || !(radius >= 0)) check_query(v, index->vertex_count(), radius);
  if (radius != bounds.radius) bounds = RadiusBounds(index->frame, radius);
  answer.clear();
  const std::uint32_t slot = index->slot[v];
  if (index->is_wall(slot)) {
    way = Way::Wall;
    return;
  }
  find(v, slot);
  if (!index->ignored.empty()) {
    if (way == Way::VertexBfs) answer.align_to_leaves();
    answer.leave_out(index->ignored);
  }
}

void StraightSearch::find(VertexId v, std::uint32_t slot) {
  if (is_odd) {
    way = Way::VertexBfs;
    vertex_bfs.run(v, bounds.leaf.squared_radius, answer);
    return;
  }
  const Leaf& leaf = index->leaves[leaf_of(slot)];
  leaf_bfs.prefetch_leaf(leaf, true);
  if (is_tiny() && is_alone(slot)) {
    way = Way::Alone;
    answer.add_lanes({leaf_of(slot), LaneMask{1} << lane_of(slot)});
    return;
  }
  const Query query(*index, v, bounds);
  // A leaf that is not connected has no links, so the answer is a part of it. Where the outward search would begin with
  // leaves, it saves nothing.
  if (is_small(leaf) || !leaf.connected || !reach.run(query)) {
    way = Way::LeafBfs;
    leaf_bfs.run(query, answer);
    return;
  }
  component.mark(query, reach);
  if (is_mostly_open() && leaf_bfs.run_within(component.open_leaves(), query, answer)) {
    way = Way::LeafBfs;
    return;
  }
  way = Way::Component;
  component.complete(reach, answer);
}

/// Returns whether the answer may well be the query vertex alone.
bool StraightSearch::is_tiny() const {
  constexpr double kMeanLeafRadii = 0.4;  // chosen
  return bounds.radius_in_frame < kMeanLeafRadii * index->tree[0].mean_radius;
}

/// Returns whether few leaves lie inside the ball, so that a search over leaves takes no longer than `Reach`.
bool StraightSearch::is_small(const Leaf& leaf) const {
  constexpr double kLeafRadii = 4.5;  // chosen
  // Where the mesh is finer, its leaves are smaller. A leaf that is much larger than others says nothing.
  const double radius = std::min(static_cast<double>(leaf.bounds.radius), index->tree[0].mean_radius);
  return bounds.radius_in_frame < kLeafRadii * radius;
}

/// Returns whether the marks have left most of the surface open. Then most of what was reached is likely not connected
/// with the query vertex, and a search over as many leaves as are open takes less time than to unite what is open.
bool StraightSearch::is_mostly_open() const { return 2 * component.open_leaves() > reach.surface_leaves().size(); }

/// Returns whether no neighbor of the vertex at a slot, the center of the ball, is in the ball. Walls count as
/// neighbors, so that the answer may be false although the vertex is alone.
bool StraightSearch::is_alone(std::uint32_t slot) const {
  const Point center = index->position_at(slot);
  return std::visit(
      [&](auto xyz) {
        bool result = true;
        for_each_neighbor(*index, slot, [&](std::size_t other) {
          result &= !(squared_distance(point(xyz, other), center) <= bounds.leaf.squared_radius);
        });
        return result;
      },
      index->positions);
}

}  // namespace meshhood::inline v0_1
