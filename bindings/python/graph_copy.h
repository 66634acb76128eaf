// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood::python {

/// Positions that other threads may write to, copied before they are validated; no edges.
///
/// Throws Error{InvalidMesh, TooLarge}. The message begins with `argument`.
[[nodiscard]] GraphData positions_copy(const PositionsView& positions, const char* argument);

/// The graph of a mesh whose positions other threads may write to. Copies them first.
///
/// Throws Error{InvalidMesh, TooLarge}. The message begins with the argument: `V` or `F`.
[[nodiscard]] GraphData graph_copy(const MeshView& mesh);

/// Throws Error{InvalidMesh} unless the faces are those of the graph: some of its faces, or all of them if edges were
/// cut. So the edges of one are edges of the other. The message begins with the argument: `F`.
void check_faces(const GraphView& graph, const FacesView& faces);

/// Throws Error{TooLarge} for more vertices than there are ids in Python.
void check_vertex_count(std::size_t count);

}  // namespace meshhood::python
