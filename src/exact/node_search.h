// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>

#include "exact/layout.h"

namespace meshhood::inline v0_1 {

/// Returns the bounding sphere of the node at a place of a group.
[[nodiscard]] inline FrameSphere sphere_of(const Group& group, std::size_t place) {
  return {group.x[place], group.y[place], group.z[place], group.radius[place]};
}

/// Returns the bounding sphere of a node of the tree.
[[nodiscard]] inline FrameSphere sphere_of(const IndexView& index, NodeId node) {
  return sphere_of(index.groups[node / kFanOut], node % kFanOut);
}

/// Returns the set of the node at a place.
[[nodiscard]] constexpr NodeSet node_at(unsigned place) { return static_cast<NodeSet>(1U << place); }

/// Calls `f(place)` for every node of the set, in ascending order.
template <class F>
void for_each_node(NodeSet nodes, F&& f) {
  for (unsigned left = nodes; left != 0; left &= left - 1) f(static_cast<unsigned>(std::countr_zero(left)));
}

/// Returns the nodes of a group that can be reached from `from` by links within `among`; `from` is a part of it.
[[nodiscard]] inline NodeSet reachable_nodes(const std::array<NodeSet, kFanOut>& linked, NodeSet from, NodeSet among) {
  assert((from & ~among) == 0);
  unsigned reached = from;
  for (unsigned todo = from; todo != 0;) {
    const unsigned added = linked[static_cast<unsigned>(std::countr_zero(todo))] & among & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return static_cast<NodeSet>(reached);
}

}  // namespace meshhood::inline v0_1
