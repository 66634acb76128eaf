// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "aggregate/node_tree.h"
#include "aggregate/signal_block.h"
#include "base/vector.h"
#include "simd/aggregate.h"

namespace meshhood {

/// The moments of a column over each node, about its center (see `NodeTree::center`), in units of the frame.
[[nodiscard]] std::vector<Moments> moments_by_node(const IndexView& index, const NodeTree& tree, const Column& column);

/// The same moments about the point that lies at `-step` from the present one: every offset grows by `step`.
[[nodiscard]] Moments shifted(const Moments& moments, const Point& step);

/// The same moments in a unit in which lengths are `factor` times as large.
[[nodiscard]] Moments rescaled(const Moments& moments, double factor);

}  // namespace meshhood
