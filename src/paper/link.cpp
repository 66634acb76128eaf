// SPDX-License-Identifier: MIT
// Implements step 3 of sec. 3.2, link. A cluster has the vertices of its children. Its siblings are the other clusters
// that are parents of siblings of its children. Spheres are computed last (`enclose`).
#include <algorithm>
#include <utility>

#include "paper/draft.h"

namespace meshhood::inline v0_1::paper {
namespace {

void link_siblings(const DraftLevel& below, const Partition& partition, DraftLevel& level) {
  const auto children = child_lists(partition.parent, partition.clusters);
  Adjacency& siblings = level.own_siblings;
  siblings.offsets.reserve(partition.clusters + 1);
  siblings.offsets.push_back(0);
  std::vector<ClusterId> listed_by(partition.clusters, kNoCluster);
  for (std::size_t c = 0; c < partition.clusters; ++c) {
    const auto cluster = static_cast<ClusterId>(c);
    listed_by[cluster] = cluster;
    for (const ClusterId child : children[cluster]) {
      for (const ClusterId neighbor : below.siblings[child]) {
        const ClusterId sibling = partition.parent[neighbor];
        if (std::exchange(listed_by[sibling], cluster) != cluster) siblings.neighbors.push_back(sibling);
      }
    }
    std::sort(siblings.neighbors.begin() + siblings.offsets.back(), siblings.neighbors.end());
    siblings.offsets.push_back(static_cast<EdgeOffset>(siblings.neighbors.size()));
  }
  level.siblings = siblings.view();
}

}  // namespace

DraftLevel link(const DraftLevel& below, const Partition& partition) {
  DraftLevel level;
  level.vertex_count.assign(partition.clusters, 0);
  level.position_sum.assign(partition.clusters, Point{});
  for (std::size_t c = 0; c < below.size(); ++c) {
    const ClusterId parent = partition.parent[c];
    level.vertex_count[parent] = static_cast<VertexId>(level.vertex_count[parent] + below.vertex_count[c]);
    const Point& sum = below.position_sum[c];
    Point& total = level.position_sum[parent];
    total = {total.x + sum.x, total.y + sum.y, total.z + sum.z};
  }
  link_siblings(below, partition, level);
  return level;
}

}  // namespace meshhood::inline v0_1::paper
