// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "base/parallel.h"
#include "exact/build/links.h"
#include "exact/build/tree.h"

namespace meshhood {

/// The lowest level of the tree: the bounding sphere and the minimum region of each leaf; without regions, all of them
/// are unbounded. `points`: the vertices in index order, in the frame. O(#V + #E log(valence)).
[[nodiscard]] NodeList make_leaf_nodes(std::span<const VertexId> leaf_begin, const Links& links,
                                       std::span<const Point> points, bool with_regions, TaskContext& task);

}  // namespace meshhood
