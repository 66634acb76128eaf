// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "exact/layout.h"
#include "shared/distance.h"
#include "surface/face_tree.h"

namespace meshhood::inline v0_1 {

/// The cosine of the angle between the normals of a vertex and of a face from which on this is opposite. Common angles
/// of parts, as 90 and 120 degrees between sides, are far from it, so that rounding does not decide.
inline constexpr double kOpposite = 0.6;

/// Whether a face with this vector area is opposite to a vertex with this normal.
[[nodiscard]] inline bool is_opposite(const Point& area, const Point& normal) {
  return dot(area, normal) < kOpposite * length(area);
}

/// The vector area of a triangle in the unit of the frame, twice.
[[nodiscard]] inline Point doubled_area(const IndexView& index, const Triangle& triangle) {
  const double scale = index.frame.scale;
  const auto [a, b, c] = corners_of(index, triangle.corners);
  return doubled_vector_area(scale * a, scale * b, scale * c);
}

/// Its triangles are opposite to no vertex whose normal is so near the axis that the cosine of the angle between them
/// is at least `cosine`. As it stands: to none.
struct NormalCone {
  float x = 0;
  float y = 0;
  float z = 0;
  float cosine = 0;
};

/// A cone around the normals of the triangles of each group of a tree of boxes, by which a search for opposite faces
/// leaves out groups without one. 16 bytes a group, so 2.3 bytes a triangle.
class NormalCones {
 public:
  NormalCones(const IndexView& index, const FaceTree& tree);

  /// Whether a triangle of the group may be opposite to a vertex with this normal.
  [[nodiscard]] bool may_oppose(std::size_t level, std::size_t group, const Point& normal) const {
    const NormalCone& cone = levels_[level][group];
    const Point axis{static_cast<double>(cone.x), static_cast<double>(cone.y), static_cast<double>(cone.z)};
    return dot(axis, normal) < static_cast<double>(cone.cosine);
  }

  [[nodiscard]] std::size_t bytes() const;

 private:
  std::vector<std::vector<NormalCone>> levels_;  // as those of the boxes
};

}  // namespace meshhood::inline v0_1
