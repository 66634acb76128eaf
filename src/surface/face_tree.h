// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "surface/box_tree.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {

/// The triangles of all faces, and boxes around them. Those near each other in space are near each other in the tree.
/// Those of a face follow each other.
class FaceTree {
 public:
  /// Throws Error{InvalidMesh} if no face has three corners, and Error{Cancelled}. O(n log n) for n triangles.
  FaceTree(const IndexView& index, const StoredFaces& faces, TaskContext& task);

  /// The triangles and boxes of the faces `changed`, after vertices have moved. The frame must be the same.
  void renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed);

  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  [[nodiscard]] std::size_t bytes() const {
    return triangles_.size() * sizeof(Triangle) + first_.size() * sizeof(std::uint32_t) + boxes_.bytes();
  }

 private:
  [[nodiscard]] BoundingBox box_of(const IndexView& index, std::size_t i) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_;  // of the triangles of each face
  BoxTree boxes_;
};

}  // namespace meshhood::inline v0_1
