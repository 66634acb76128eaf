// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/vertex_id.h"

/// Finds what is near in space, but not connected nearby: the other side of a wall, the next fold, sheets that nearly
/// touch.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// For each row of a query, the nearest vertex in the ball that does not belong to the neighborhood.
struct Unconnected {
  std::vector<VertexId> vertex;  ///< #rows; `kNoVertex` where there is none
  std::vector<double> distance;  ///< #rows: infinite where there is none
};

/// Finds, for each row `v` with radius `r`, the nearest of the vertices that lie within `r` of `v` in space and are not
/// in the neighborhood of `v` with radius `r` (see `Searcher`); of several at the same distance, the one with the
/// smallest id. A vertex at exactly `r` counts.
///
/// *Not connected* is meant at the scale of `r`: a vertex to which only a way outside the ball leads is not connected.
/// So the edge of a sheet that bends back into the ball counts as well as another component, and a larger radius may
/// connect what was not. With an infinite radius, only other components count.
///
/// query    as for `counts`: one radius for all rows, or one for each, or scales. By paths, the neighborhood has the
///          vertices within `r` along the edges, and the ball is that of radius `r` in space. A number of edges is no
///          radius in space: by rings, the nearest of all other vertices is found. Walls and ignored vertices are never
///          the nearest, and for a wall there is none. `Metric::Space`, in which nothing is connected, is
///          Error{InvalidOption}.
///
/// The neighborhoods are found as by `counts`; what the tree of the index has in the balls besides them is searched,
/// the nearest first. So far away from any other sheet, all leaves that the surface of a ball meets are compared with
/// it. Where neighbors are not near in space, as in a random tree, all vertices are compared, as by a plain scan;
/// between hubs this takes longer than a scan. Vertices at the same place that no edge joins are not connected: of a
/// mesh whose corners were not merged, distances are 0 along its seams; weld it first (`io/weld.h`). Besides the
/// result, it needs the memory of `counts`.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
[[nodiscard]] Unconnected nearest_unconnected(const Index& index, const BatchQuery& query, const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
