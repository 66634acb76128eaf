// SPDX-License-Identifier: MIT
#pragma once

/// Copies meshes of CGAL. The header is empty unless CGAL is found.
///
///     CGAL::Surface_mesh<Kernel::Point_3> surface;
///     const meshhood::MeshData mesh = meshhood::copy_mesh(surface);
///     auto index = meshhood::build(mesh.view());
///     // The mesh deforms:
///     const auto positions = meshhood::copy_positions(surface);
///     index = meshhood::refit(index, positions);
///
/// Vertex `v` of meshhood is `CGAL::SM_Vertex_index(v)`.

#if __has_include(<CGAL/Surface_mesh.h>)

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include "meshhood/error.h"
#include "meshhood/mesh_data.h"

namespace meshhood::inline v0_1 {

/// Returns the positions, #V by 3, rounded to double. Throws Error{InvalidMesh} if vertices have been removed and the
/// mesh has not collected its garbage, because ids would not be consecutive. Takes O(#V).
template <class Point>
[[nodiscard]] std::vector<double> copy_positions(const CGAL::Surface_mesh<Point>& mesh) {
  if (mesh.number_of_removed_vertices() != 0) {
    raise(ErrorCode::InvalidMesh, "the mesh of CGAL has " + std::to_string(mesh.number_of_removed_vertices()) +
                                      " removed vertices: call collect_garbage() first");
  }
  std::vector<double> xyz;
  xyz.reserve(std::size_t{3} * mesh.number_of_vertices());
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    xyz.insert(xyz.end(), {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  return xyz;
}

/// Returns the mesh: its faces, and its edges without a face as polygons of two corners. Throws as `copy_positions`.
/// Takes O(#V + #E).
template <class Point>
[[nodiscard]] MeshData copy_mesh(const CGAL::Surface_mesh<Point>& mesh) {
  MeshData copy;
  copy.offsets.push_back(0);
  copy.positions = copy_positions(mesh);
  for (const auto face : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) {
      copy.corners.push_back(static_cast<std::uint32_t>(v.idx()));
    }
    copy.offsets.push_back(copy.corners.size());
  }
  for (const auto edge : mesh.edges()) {
    const auto halfedge = mesh.halfedge(edge);
    if (!mesh.is_border(halfedge) || !mesh.is_border(mesh.opposite(halfedge))) continue;
    copy.corners.push_back(static_cast<std::uint32_t>(mesh.source(halfedge).idx()));
    copy.corners.push_back(static_cast<std::uint32_t>(mesh.target(halfedge).idx()));
    copy.offsets.push_back(copy.corners.size());
  }
  return copy;
}

}  // namespace meshhood::inline v0_1

#endif
