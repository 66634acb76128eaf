// SPDX-License-Identifier: MIT
#pragma once

/// meshhood: the neighborhood of a point on a polygonal mesh.
///
/// The neighborhood of vertex `v` with radius `r` is the part of the mesh inside the ball of radius `r` around `v` that
/// hangs together with `v` inside that ball.
///
///     #include <meshhood/meshhood.h>
///
///     std::vector<float> positions = ...;          // #V by 3
///     std::vector<std::uint32_t> triangles = ...;  // #F by 3
///
///     const auto index = meshhood::build({positions, meshhood::FacesView::triangles(triangles)});
///     meshhood::Searcher searcher(index);    // one a thread
///     std::vector<meshhood::VertexId> near;
///     searcher.neighborhood(42, 1.5, near);  // exactly what a breadth-first search would find
///
/// `meshhood::paper` has the same calls with the approximate answers of the paper.

#include "meshhood/adjacency.h"    // IWYU pragma: export
#include "meshhood/batch.h"        // IWYU pragma: export
#include "meshhood/error.h"        // IWYU pragma: export
#include "meshhood/fingerprint.h"  // IWYU pragma: export
#include "meshhood/index.h"        // IWYU pragma: export
#include "meshhood/level.h"        // IWYU pragma: export
#include "meshhood/mesh.h"         // IWYU pragma: export
#include "meshhood/paper.h"        // IWYU pragma: export
#include "meshhood/progress.h"     // IWYU pragma: export
#include "meshhood/reference.h"    // IWYU pragma: export
#include "meshhood/reorder.h"      // IWYU pragma: export
#include "meshhood/search.h"       // IWYU pragma: export
#include "meshhood/searcher.h"     // IWYU pragma: export
#include "meshhood/serialize.h"    // IWYU pragma: export
