// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "exact/build/kd_order.h"
#include "exact/build/node_parts.h"

namespace meshhood {

/// Divides nodes into parts that lie close together and are connected by links: the connected parts of the cells of a
/// kd order, of which small ones are joined. O(links).
///
/// order  the nodes of `graph` that have links, in a kd order of eight
[[nodiscard]] NodeParts connected_parts(const NodeGraph& graph, std::span<const KdPoint> order);

}  // namespace meshhood
