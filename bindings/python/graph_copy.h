// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood::python {

/// What an index is built from, so that the arrays cannot change under it: a function that is told of the progress may
/// do anything.
///
/// Throws Error{InvalidMesh, TooLarge}, beginning with the argument: `V` or `F`.
[[nodiscard]] GraphData graph_copy(const MeshView& mesh);

/// Throws Error{TooLarge} for more vertices than there are ids in Python.
void check_vertex_count(std::size_t count);

}  // namespace meshhood::python
