// SPDX-License-Identifier: MIT
#pragma once

/// meshhood finds the connected component of a mesh inside a ball around a vertex, exactly, with an index.
///
/// The neighborhood of vertex `v` with radius `r` is the connected component of `v` in the part of the mesh inside the
/// ball of radius `r` around `v`.
///
///     #include <meshhood/meshhood.h>
///
///     std::vector<float> positions = ...;          // #V by 3
///     std::vector<std::uint32_t> triangles = ...;  // #F by 3
///
///     const auto index = meshhood::build(positions, triangles);
///     meshhood::Searcher searcher(index);             // one per thread
///     const auto ids = searcher.neighborhood(42, 1.5);  // the same set as breadth-first search
///
/// `Searcher`, for one vertex or point, and visitors are in search.h, batches over many vertices in batch.h, sums over
/// neighborhoods in aggregate.h and moments.h, walls in masks.h, meshes that deform in refit.h. `Surface`, for closest
/// points, regions as meshes and curvature, is in surface.h; areas, volumes and gaps in a ball are in patch.h. Files
/// are in io/mesh_io.h and io/index_io.h. Meshes of other libraries are in eigen.h, cgal.h, openmesh.h and
/// geometry_central.h. `meshhood::paper` has an index and a searcher for the approximate neighborhoods of the paper; a
/// `SearchMethod` of it makes batches.

#include "meshhood/adjacency.h"      // IWYU pragma: export
#include "meshhood/aggregate.h"      // IWYU pragma: export
#include "meshhood/batch.h"          // IWYU pragma: export
#include "meshhood/curvature.h"      // IWYU pragma: export
#include "meshhood/error.h"          // IWYU pragma: export
#include "meshhood/face_graph.h"     // IWYU pragma: export
#include "meshhood/features.h"       // IWYU pragma: export
#include "meshhood/fingerprint.h"    // IWYU pragma: export
#include "meshhood/index.h"          // IWYU pragma: export
#include "meshhood/k_nearest.h"      // IWYU pragma: export
#include "meshhood/kernel_target.h"  // IWYU pragma: export
#include "meshhood/level.h"          // IWYU pragma: export
#include "meshhood/link_points.h"    // IWYU pragma: export
#include "meshhood/masks.h"          // IWYU pragma: export
#include "meshhood/mesh.h"           // IWYU pragma: export
#include "meshhood/mesh_data.h"      // IWYU pragma: export
#include "meshhood/metric.h"         // IWYU pragma: export
#include "meshhood/moments.h"        // IWYU pragma: export
#include "meshhood/paper.h"          // IWYU pragma: export
#include "meshhood/patch.h"          // IWYU pragma: export
#include "meshhood/reference.h"      // IWYU pragma: export
#include "meshhood/refit.h"          // IWYU pragma: export
#include "meshhood/reorder.h"        // IWYU pragma: export
#include "meshhood/run.h"            // IWYU pragma: export
#include "meshhood/search.h"         // IWYU pragma: export
#include "meshhood/serialize.h"      // IWYU pragma: export
#include "meshhood/start.h"          // IWYU pragma: export
#include "meshhood/surface.h"        // IWYU pragma: export
#include "meshhood/unconnected.h"    // IWYU pragma: export
#include "meshhood/version.h"        // IWYU pragma: export
#include "meshhood/vertex.h"         // IWYU pragma: export
