// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/run.h"

/// Makes a graph of points without faces by joining near ones.
///
///     const auto index = meshhood::build_linked(points, 0.9);
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

struct LinkOptions {
  /// A graph with more edges is refused.
  std::size_t max_edges = kMaxNeighbors / 2;
};

/// Returns the graph that joins any two points at most `link` apart (see `distance`), such as two at the same place.
///
/// points  #V by 3, as the positions of a mesh; borrowed for the call.
/// link    >= 0 and finite, in the unit of the points.
///
/// The points are sorted into the cells of a grid; one pass counts the neighbors and one lists them. Takes O(#V log #V
/// + #pairs of points in neighboring cells). Outliers do not make the cells larger: where some are 2^50 times `link`
/// away, the points are cut at gaps first, and each part has a grid of its own. Needs memory for the result, and at
/// most 80 bytes a point.
///
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}; TooLarge, with the limit, if there are more than
/// `max_edges`, as soon as so many are counted.
[[nodiscard]] Adjacency link_points(const PositionsView& points, double link, const LinkOptions& options = {},
                                    const Run& run = {});

/// Returns the index that `build` makes of this graph, in less time, as it checks no graph. Throws as `link_points`.
[[nodiscard]] Index build_linked(const PositionsView& points, double link, const LinkOptions& options = {},
                                 const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
