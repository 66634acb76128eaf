// SPDX-License-Identifier: MIT
#include "exact/search/local_minima.h"

#include <algorithm>
#include <tuple>

#include "base/distance.h"
#include "base/prefetch.h"

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

void append_minima_of(const IndexView& index, const Kernels& kernels, LeafId leaf, const Query& query,
                      std::vector<LocalMinimum>& out) {
  const Leaf& record = index.leaves[leaf];
  const LaneMask inside = kernels.within(index.positions, record.first, record.size, query.ball);
  const LaneMask query_lane = query.leaf() == leaf ? query.lane() : 0;
  for (LaneMask left = inside; left != 0;) {
    const bool is_whole = record.connected && left == first_lanes(record.size);
    const LaneMask part = is_whole ? left : kernels.reachable(&index.adjacency[record.first], left, left & -left);
    left &= ~part;
    if ((part & query_lane) != 0) continue;  // mutant: query-leaf-has-no-minimum
    const Nearest nearest = kernels.nearest(index.positions, record.first, part, query.ball);
    const LocalMinimum vertex{nearest.square, leaf, nearest.lane};
    if (!has_nearer_neighbor_outside(index, vertex, query.centre())) out.push_back(vertex);
  }
}

/// Whether all vertices of the leaf are in the ball and connected there.
bool is_whole(const IndexView& index, LeafId leaf, const TreeBall& ball) {
  const Leaf& record = index.leaves[leaf];
  // mutant: disconnected-leaf-is-whole
  return record.connected && classify(record.bounds, ball) == Containment::Inside;
}

bool are_linked(const IndexView& index, LeafId a, LeafId b) {
  const std::span<const Link> links = index.links_of(a);
  return std::any_of(links.begin(), links.end(), [b](const Link& link) { return link.leaf == b; });
}

/// Prefetches what `append_minima_of` reads of the leaves that come next: their records first, and what those point to
/// once they have arrived.
void prefetch_ahead(const IndexView& index, std::span<const LeafId> next) {
  constexpr std::size_t kRecord = 9;
  constexpr std::size_t kContents = 6;
  constexpr std::size_t kCrossEdges = 3;
  if (next.size() > kRecord) prefetch(&index.leaves[next[kRecord]]);
  if (next.size() > kContents) {
    const Leaf& leaf = index.leaves[next[kContents]];
    prefetch_positions(index, leaf.first, leaf.size);
    fetch_lines(&index.adjacency[leaf.first], 2);
    fetch_lines(&index.links[leaf.first_link], 2);
  }
  if (next.size() > kCrossEdges) {
    const Link& link = index.links[index.leaves[next[kCrossEdges]].first_link];
    fetch_lines(&index.cross_edges[link.first_cross_edge], 2);
    fetch_lines(&index.leaf_begin[link.leaf], 1);
  }
}

}  // namespace

void find_local_minima(const IndexView& index, const Kernels& kernels, std::span<const LeafId> leaves,
                       const Query& query, std::vector<LocalMinimum>& out) {
  out.clear();
  const LeafId home = query.leaf();
  const bool home_is_whole = is_whole(index, home, query.tree_ball);
  for (std::size_t i = 0; i < leaves.size(); ++i) {  // mutant: first-candidate-ignored
    prefetch_ahead(index, leaves.subspan(i));
    const LeafId leaf = leaves[i];
    // The leaves around the query vertex are always candidates, and mostly connected with it as a whole.
    if (home_is_whole && (leaf == home || (are_linked(index, home, leaf) && is_whole(index, leaf, query.tree_ball)))) {
      continue;
    }
    append_minima_of(index, kernels, leaf, query, out);
  }
  std::sort(out.begin(), out.end(), [](const LocalMinimum& a, const LocalMinimum& b) {
    return std::tie(a.square, a.leaf, a.lane) < std::tie(b.square, b.leaf, b.lane);
  });
}

}  // namespace meshhood
