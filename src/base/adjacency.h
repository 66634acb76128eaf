// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

#include "base/lists.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Calls `f(v, w)` for every pair of consecutive distinct corners of the polygons `begin .. end - 1`, the last with the
/// first. A side that several polygons share is repeated. The polygons must be valid.
template <class F>
void for_each_side(const FacesView& faces, std::size_t begin, std::size_t end, F&& f) {
  faces.for_each(begin, end, [&](std::size_t, std::span<const VertexId> corners) {
    if (corners.empty()) return;
    VertexId previous = corners.back();
    for (const VertexId corner : corners) {
      if (corner != previous) f(previous, corner);
      previous = corner;
    }
  });
}

/// Fills rows of neighbors as the other `gather_rows` fills lists. There are at most `kMaxNeighbors` neighbors.
template <class ForEach>
[[nodiscard]] Adjacency gather_rows(std::size_t vertices, ForEach&& for_each) {
  Adjacency result;
  gather_rows(vertices, for_each, result.offsets, result.neighbors);
  return result;
}

/// Throws Error{TooLarge} if the neighbors over all vertices may be more than `kMaxNeighbors`.
void check_corner_count(const FacesView& faces);

/// Returns the graph of a mesh, on several threads.
[[nodiscard]] Adjacency adjacency(const MeshView& mesh, TaskContext& task);

}  // namespace meshhood::inline v0_1
