// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/surface.h"

#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "shared/distance.h"
#include "surface/box_tree.h"
#include "surface/triangle_point.h"

namespace meshhood {

/// A triangle of the triangulation of a face.
struct Triangle {
  std::array<std::uint32_t, 3> corners;  // places in index order
  std::uint32_t face;
  std::uint32_t diagonals;  // a bit for each of its sides that lies inside the face
};

/// The triangles of all faces (see base/triangulate.h), and boxes around them. They are in the order of the first
/// corner of their face in index order, then of their faces, so that those near each other in the tree are near each
/// other on the surface.
class FaceTree {
 public:
  /// Throws Error{InvalidMesh} if no face has three corners.
  FaceTree(const IndexView& index, const StoredFaces& faces);

  /// The triangles and boxes of the faces `changed`, after vertices have moved. The frame must be the same.
  void renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed);

  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] std::size_t bytes() const { return triangles_.size() * sizeof(Triangle) + boxes_.bytes(); }

 private:
  [[nodiscard]] BoundingBox box_of(const IndexView& index, std::size_t i) const;

  std::vector<Triangle> triangles_;
  BoxTree boxes_;
};

/// The positions of the corners of a triangle.
[[nodiscard]] std::array<Point, 3> corners_of(const IndexView& index, const std::array<std::uint32_t, 3>& places);

/// A point of a triangle of a face, with these corners, as callers see it.
[[nodiscard]] SurfacePoint surface_point(const IndexView& index, const StoredFaces& faces, std::size_t face,
                                         const std::array<std::uint32_t, 3>& places, const TrianglePoint& found);

}  // namespace meshhood
