// SPDX-License-Identifier: MIT
#pragma once

/// Copies meshes of OpenMesh. The header is empty unless OpenMesh is found.
///
///     #include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
///
///     OpenMesh::TriMesh_ArrayKernelT<> surface;
///     const meshhood::MeshData mesh = meshhood::copy_mesh(surface);
///     auto index = meshhood::build(mesh.view());
///     // The mesh deforms:
///     const auto positions = meshhood::copy_positions(surface);
///     index = meshhood::refit(index, positions);
///
/// Vertex `v` of meshhood is `OpenMesh::VertexHandle(v)`.

#if __has_include(<OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>)

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "meshhood/error.h"
#include "meshhood/mesh_data.h"

namespace meshhood::inline v0_1 {

/// Returns the positions, #V by 3, in float if the mesh has float, else in double. Throws Error{InvalidMesh} if
/// vertices are deleted but the garbage is not collected, because ids would not be consecutive. Takes O(#V).
template <class Kernel>
[[nodiscard]] auto copy_positions(const OpenMesh::PolyMeshT<Kernel>& mesh) {
  using Scalar = typename OpenMesh::PolyMeshT<Kernel>::Scalar;
  using Real = std::conditional_t<std::is_same_v<Scalar, float>, float, double>;
  const auto is_deleted = [&](OpenMesh::VertexHandle v) { return mesh.status(v).deleted(); };
  if (mesh.has_vertex_status() && std::any_of(mesh.vertices_begin(), mesh.vertices_end(), is_deleted)) {
    raise(ErrorCode::InvalidMesh, "the mesh of OpenMesh has deleted vertices: call garbage_collection() first");
  }
  std::vector<Real> xyz;
  xyz.reserve(3 * mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    xyz.insert(xyz.end(), {static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])});
  }
  return xyz;
}

/// Returns the mesh. Throws as `copy_positions`. Takes O(#V + #corners).
template <class Kernel>
[[nodiscard]] MeshData copy_mesh(const OpenMesh::PolyMeshT<Kernel>& mesh) {
  MeshData copy;
  copy.offsets.push_back(0);
  copy.positions = copy_positions(mesh);
  for (const auto face : mesh.faces()) {
    for (const auto v : mesh.fv_range(face)) copy.corners.push_back(static_cast<std::uint32_t>(v.idx()));
    copy.offsets.push_back(copy.corners.size());
  }
  return copy;
}

}  // namespace meshhood::inline v0_1

#endif
