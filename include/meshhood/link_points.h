// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"

/// Points without faces: the graph that joins near ones.
///
///     const auto index = meshhood::build_linked(points, 0.9);
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

struct LinkOptions {
  /// A graph with more edges is refused.
  std::size_t max_edges = kMaxNeighbors / 2;
};

/// The graph that joins any two points whose distance (see `distance`) is at most `link`; so points at the same place
/// are joined, too.
///
/// points  #V by 3, as the positions of a mesh; borrowed for the call.
/// link    >= 0 and finite, in the unit of the points.
///
/// By the cells of a grid, in one pass to count the neighbors and one to list them: O(#V log #V) and the number of
/// pairs of points in neighboring cells. Outliers do not make the cells larger: where some are 2^50 times `link` away,
/// the points are cut at gaps first, and each part has a grid of its own. Memory: the result, and 52 bytes a point.
///
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}; TooLarge, with the limit, if there are more than
/// `max_edges`, as soon as so many are counted.
[[nodiscard]] Adjacency link_points(const PositionsView& points, double link, const LinkOptions& options = {},
                                    const Run& run = {});

/// The index of this graph: what `build` makes of it, in less time, because the graph is not checked. Throws the same.
[[nodiscard]] Index build_linked(const PositionsView& points, double link, const LinkOptions& options = {},
                                 const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
