// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "shared/distance.h"
#include "surface/box_tree.h"

namespace meshhood {

/// A triangle of the fan of a face.
struct Triangle {
  std::array<std::uint32_t, 3> corners;  // places in index order
  std::uint32_t face;
  std::uint32_t second;  // see `SurfacePoint::second_corner`
};

/// The triangles of the faces, and boxes around them. They are in the order of their first corners in index order, then
/// of their faces, so that those near each other in the tree are near each other on the surface.
class FaceTree {
 public:
  /// Throws Error{InvalidMesh} if no face has three corners.
  FaceTree(const IndexView& index, const StoredFaces& faces);

  /// The boxes of the faces `changed`, after vertices have moved. The frame must be the same.
  void renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed);

  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] const Triangle& operator[](std::size_t i) const { return triangles_[i]; }
  [[nodiscard]] std::size_t bytes() const { return triangles_.size() * sizeof(Triangle) + boxes_.bytes(); }

 private:
  [[nodiscard]] BoundingBox box_of(const IndexView& index, std::size_t i) const;

  std::vector<Triangle> triangles_;
  BoxTree boxes_;
};

}  // namespace meshhood
