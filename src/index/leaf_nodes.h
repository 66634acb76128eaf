// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "index/links.h"
#include "index/tree.h"
#include "parallel.h"

namespace meshhood {

/// The lowest level of the tree: the bounding sphere and the column of each leaf. `points`: the vertices in index
/// order, in the frame. O(#V + #E log(valence)).
[[nodiscard]] NodeList make_leaf_nodes(std::span<const VertexId> leaf_begin, const Links& links,
                                       std::span<const Point> points, bool with_columns, Work& work);

}  // namespace meshhood
