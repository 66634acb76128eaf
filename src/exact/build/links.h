// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/build/edge_source.h"
#include "exact/layout.h"
#include "shared/parallel.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// The edges of the mesh, by leaf; or by cell, which then takes the place of a leaf.
struct Links {
  RawVector<LaneMask> adjacency;        // in the order of the leaves: the neighbors in the same leaf
  std::vector<std::uint32_t> link_end;  // by leaf: the end of its links
  std::vector<Link> links;              // by leaf, then by linked leaf; one more, for the end of the last cross edges
  std::vector<CrossEdge> cross_edges;   // by link, then by `from`, then by `to`

  [[nodiscard]] std::span<const Link> links_of(std::size_t leaf) const {
    assert(leaf < link_end.size());
    const std::size_t begin = leaf == 0 ? 0 : link_end[leaf - 1];
    return std::span(links).subspan(begin, link_end[leaf] - begin);
  }

  /// `link` must be an element of `links`.
  [[nodiscard]] std::span<const CrossEdge> cross_edges_of(const Link& link) const {
    assert(&link >= links.data() && &link + 1 < links.data() + links.size());
    const std::size_t end = (&link + 1)->first_cross_edge;
    return std::span(cross_edges).subspan(link.first_cross_edge, end - link.first_cross_edge);
  }
};

/// Every edge of the mesh in both directions.
///
/// slot   by vertex: 32 times its leaf, plus its lane
/// begin  by leaf, and one more: its first vertex in the order of the leaves
/// Throws Error{Cancelled}. O(#V + edges of the source).
[[nodiscard]] Links make_links(const EdgeSource& edges, std::span<const std::uint32_t> slot,
                               std::span<const VertexId> begin, TaskContext& task);

/// Links of consecutive runs of leaves, each numbered from 0, as one. Without `adjacency`.
[[nodiscard]] Links join_runs(std::span<const Links> runs);

/// Whether the `size` vertices of a leaf are connected by the edges between them; true for one and for none.
[[nodiscard]] bool is_connected(const LaneMask* adjacency, unsigned size);

/// The lanes of a leaf that can be reached from `from` by the edges within the leaf, `from` included. `adjacency[i]`
/// are the neighbors of lane `i`.
[[nodiscard]] inline LaneMask reachable_lanes(const LaneMask* adjacency, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

}  // namespace meshhood::inline v0_1
