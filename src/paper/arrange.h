// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "meshhood/adjacency.h"

#include "paper/hierarchy.h"

namespace meshhood::paper {

/// Lays out the levels that are kept, without their spheres.
///
/// xyz         #V by 3, in the caller's order.
/// parents     parents[l][c]: the parent, on level `l + 1`, of cluster `c` on level `l`; a base cluster is its vertex.
/// siblings    siblings[l]: of the clusters of level `l`; levels below `lowest` are not read.
/// lowest      the lowest level to keep; the highest is `parents.size()`.
template <class Real>
[[nodiscard]] Hierarchy<Real> arrange(std::span<const Real> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                      const std::vector<AdjacencyView>& siblings, std::size_t lowest);

}  // namespace meshhood::paper
