// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/filter.h"
#include "meshhood/index.h"

namespace meshhood {

/// The same index for searches that a filter restricts: their answers are as if walls were not in the mesh, and have no
/// ignored vertices. Shares the positions, edges and spheres of `index`, all of which remain valid without the walls: a
/// sphere still contains what is below it, and a link may be one more than is needed. What would be wrong is changed in
/// copies, of some 50 bytes a leaf:
///
/// - the walls of each leaf are kept as lanes, which every search takes out of those that are in the ball;
/// - a leaf with walls is not connected, and every node above it is *pierced*, that is never whole. So a search goes
///   down to the vertices wherever there are walls.
///
/// The masks are copied. Without a filter, shares everything. O(#V) with walls or ignored vertices; `threads` as in
/// `BuildOptions`. Throws Error{InvalidOption} unless each mask is empty or has a value for each vertex.
[[nodiscard]] Index filtered(const Index& index, const Filter& filter, unsigned threads);

}  // namespace meshhood
