// SPDX-License-Identifier: MIT
#pragma once

/// Copies meshes of geometry-central. The header is empty unless geometry-central is found.
///
///     auto [surface, geometry] = geometrycentral::surface::readManifoldSurfaceMesh("hand.ply");
///     const meshhood::MeshData mesh = meshhood::copy_mesh(*surface, geometry->inputVertexPositions);
///     auto index = meshhood::build(mesh.view());
///     // The mesh deforms:
///     const auto positions = meshhood::copy_positions(*surface, geometry->inputVertexPositions);
///     index = meshhood::refit(index, positions);
///
/// Vertex `v` of meshhood is `surface->vertex(v)`.

#if __has_include(<geometrycentral/surface/surface_mesh.h>)

#include <cstdint>
#include <vector>

#include <geometrycentral/surface/surface_mesh.h>
#include <geometrycentral/utilities/vector3.h>

#include "meshhood/error.h"
#include "meshhood/mesh_data.h"

namespace meshhood::inline v0_1 {

/// Returns the positions, #V by 3. The mesh must be compressed, so that ids are consecutive; throws Error{InvalidMesh}
/// if it is not. Takes O(#V).
[[nodiscard]] inline std::vector<double> copy_positions(
    geometrycentral::surface::SurfaceMesh& mesh,
    const geometrycentral::surface::VertexData<geometrycentral::Vector3>& positions) {
  if (!mesh.isCompressed()) {
    raise(ErrorCode::InvalidMesh, "the mesh of geometry-central is not compressed: call compress() first");
  }
  std::vector<double> xyz;
  xyz.reserve(3 * mesh.nVertices());
  for (const auto v : mesh.vertices()) {
    const geometrycentral::Vector3& p = positions[v];
    xyz.insert(xyz.end(), {p.x, p.y, p.z});
  }
  return xyz;
}

/// Returns the mesh. Throws as `copy_positions`. Takes O(#V + #corners).
[[nodiscard]] inline MeshData copy_mesh(
    geometrycentral::surface::SurfaceMesh& mesh,
    const geometrycentral::surface::VertexData<geometrycentral::Vector3>& positions) {
  MeshData copy;
  copy.offsets.push_back(0);
  copy.positions = copy_positions(mesh, positions);
  for (const auto face : mesh.faces()) {
    for (const auto v : face.adjacentVertices()) copy.corners.push_back(static_cast<std::uint32_t>(v.getIndex()));
    copy.offsets.push_back(copy.corners.size());
  }
  return copy;
}

}  // namespace meshhood::inline v0_1

#endif
