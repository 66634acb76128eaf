// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Calls `f(from, to)` for every edge in both directions, by positions in index order.
template <class F>
void for_each_edge(const IndexView& index, F&& f) {
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    const std::size_t begin = index.leaf_begin[leaf];
    for (std::size_t i = begin; i < index.leaf_begin[leaf + 1]; ++i) {
      for_each_lane(index.adjacency[i], [&](unsigned lane) { f(i, begin + lane); });
    }
    for (const Link& link : index.links_of(leaf)) {
      const std::size_t other = index.leaf_begin[link.leaf];
      for (const CrossEdge& edge : index.cross_edges_of(link)) f(begin + edge.from, other + edge.to);
    }
  }
}

/// Calls `f(to)` for the neighbors of the vertex at a slot, by positions in index order.
template <class F>
void for_each_neighbor(const IndexView& index, std::uint32_t slot, F&& f) {
  const LeafId leaf = leaf_of(slot);
  const unsigned lane = lane_of(slot);
  const std::size_t begin = index.leaf_begin[leaf];
  for_each_lane(index.adjacency[begin + lane], [&](unsigned other) { f(begin + other); });
  for (const Link& link : index.links_of(leaf)) {
    if ((link.boundary >> lane & 1U) == 0) continue;
    const std::size_t other = index.leaf_begin[link.leaf];
    for (const CrossEdge& edge : index.cross_edges_of(link)) {
      if (edge.from == lane) f(other + edge.to);
    }
  }
}

/// To be called for every vertex or edge; it polls seldom enough to cost nothing.
inline void poll_cancel(TaskContext& task, std::size_t vertex) {
  constexpr std::size_t kInterval = 1024;
  if (vertex % kInterval == 0) task.should_continue(0);
}

}  // namespace meshhood::inline v0_1
