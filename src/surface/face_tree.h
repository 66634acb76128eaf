// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "shared/distance.h"
#include "surface/box_tree.h"
#include "surface/face_triangles.h"

namespace meshhood::inline v0_1 {

/// The triangles of all faces, and boxes around them. Those near each other in space are near each other in the tree;
/// those of a face follow each other.
class FaceTree {
 public:
  /// Throws Error{InvalidMesh} if no face has three corners, and Error{Cancelled}. O(n log n) for n triangles.
  FaceTree(const IndexView& index, const StoredFaces& faces, TaskContext& task);

  /// Renews the triangles and boxes of the faces `changed`, after vertices have moved. The frame must be the same.
  void renew(const IndexView& index, const StoredFaces& faces, std::span<const std::uint32_t> changed);

  [[nodiscard]] const BoxTree& boxes() const { return boxes_; }
  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }

  /// Returns the triangles of a face that has `corners` corners.
  [[nodiscard]] std::span<const Triangle> triangles_of(std::size_t face, std::size_t corners) const {
    return triangles().subspan(first_[face], triangle_count(corners));
  }

  [[nodiscard]] std::size_t bytes() const {
    return triangles_.size() * sizeof(Triangle) + first_.size() * sizeof(std::uint32_t) + boxes_.bytes();
  }

 private:
  [[nodiscard]] BoundingBox box_of(const IndexView& index, std::size_t i) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_;  // of the triangles of each face
  BoxTree boxes_;
};

/// The cosine of the angle between a normal and that of a face, below which the face is opposite. Common angles of
/// parts, as 90 and 120 degrees between sides, are far from it, so that rounding does not decide.
inline constexpr double kOpposite = 0.6;

/// Returns whether a face with this vector area is opposite to a normal.
[[nodiscard]] inline bool is_opposite(const Point& area, const Point& normal) {
  return dot(area, normal) < kOpposite * length(area);
}

/// Returns twice the vector area of a triangle, in the unit of the frame.
[[nodiscard]] inline Point doubled_area(const IndexView& index, const Triangle& triangle) {
  const double scale = index.frame.scale;
  const auto [a, b, c] = corners_of(index, triangle.corners);
  return doubled_vector_area(scale * a, scale * b, scale * c);
}

/// The triangles of a cone are opposite to no normal for which the cosine of its angle with the axis is at least
/// `cosine`; by default to none.
struct NormalCone {
  float x = 0;
  float y = 0;
  float z = 0;
  float cosine = 0;
};

/// A cone around the normals of the triangles of each group of a tree of boxes, by which a search for opposite faces
/// leaves out groups without one. It takes 16 bytes a group, so 2.3 bytes a triangle.
class NormalCones {
 public:
  NormalCones(const IndexView& index, const FaceTree& tree);

  /// Returns whether a triangle of the group may be opposite to a normal.
  [[nodiscard]] bool may_oppose(std::size_t level, std::size_t group, const Point& normal) const {
    const NormalCone& cone = levels_[level][group];
    const Point axis{static_cast<double>(cone.x), static_cast<double>(cone.y), static_cast<double>(cone.z)};
    return dot(axis, normal) < static_cast<double>(cone.cosine);
  }

  /// Returns the diagonal of the box around all triangles, in the frame.
  [[nodiscard]] double diagonal() const { return diagonal_; }

  [[nodiscard]] std::size_t bytes() const;

 private:
  std::vector<std::vector<NormalCone>> levels_;  // as those of the boxes
  double diagonal_ = 0;
};

}  // namespace meshhood::inline v0_1
