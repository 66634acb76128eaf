// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Returns the graph of the faces of a mesh, for data that lies on faces: its vertices are the faces, at the mean of
/// their corners, in double; two faces are joined if they have an edge in common. All faces of a non-manifold edge are
/// joined with each other. `build` of its view gives an index whose ids are numbers of faces.
///
/// Throws Error{InvalidMesh, TooLarge} if `mesh` is invalid; InvalidMesh also for a face without corners, which has no
/// place; and TooLarge beyond `kMaxNeighbors`. Takes O(n log n) for n corners and neighbors, on one thread.
[[nodiscard]] GraphData face_graph(const MeshView& mesh);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
