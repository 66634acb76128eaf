// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"
#include "meshhood/progress.h"

/// Points without faces: the graph that joins near ones.
///
///     const auto graph = meshhood::link_points(points, 0.9);
///     const auto index = meshhood::build({points, graph.view()});
namespace meshhood {

struct LinkOptions {
  /// A graph with more edges is refused.
  std::size_t max_edges = kMaxNeighbors / 2;

  /// As for `build`. The result does not depend on `threads`.
  unsigned threads = 1;
  Progress progress = {};
};

/// The graph that joins any two points whose distance (see `distance`) is at most `link`; so points at the same place
/// are joined, too.
///
/// points  #V by 3, as the positions of a mesh; borrowed for the call.
/// link    >= 0 and finite, in the unit of the points.
///
/// Two passes over an index of the points without edges, one to count the neighbors and one to list them: O(#V log #V)
/// and the number of pairs of points whose leaves are within `link`. So outliers and clusters cost no more than other
/// points with as many neighbors, as long as `link` is not much less than a millionth of the extent of all points: the
/// tree is stored in single precision. Memory: the result, and an index.
///
/// Throws Error{InvalidMesh, TooLarge, InvalidOption, Cancelled}; TooLarge, with the limit, if there are more than
/// `max_edges`, as soon as so many are counted.
[[nodiscard]] Adjacency link_points(const PositionsView& points, double link, const LinkOptions& options = {});

}  // namespace meshhood
