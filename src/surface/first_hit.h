// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "base/frame.h"
#include "exact/layout.h"
#include "shared/distance.h"
#include "surface/face_tree.h"
#include "surface/triangle_point.h"

namespace meshhood {

/// A ray as S. Woop, C. Benthin, I. Wald see it ("Watertight ray/triangle intersection", Journal of Computer Graphics
/// Techniques 2, 2013): space is sheared along the main axis of the ray, so that the ray becomes this axis, and seen
/// along it. A corner is seen at the same place whatever its triangle, and on which side of a line between two of them
/// the ray passes is decided exactly. So it cannot slip through where triangles meet.
class Ray {
 public:
  /// `direction` is finite and not 0.
  Ray(const Point& origin, const Point& direction, const Frame& frame);

  /// Where it meets a triangle: at a corner or on a side, the weights of the others are exactly 0, and the distance is
  /// that of each triangle there, bit for bit. None for a triangle that is seen from its side, or without an area.
  [[nodiscard]] std::optional<TrianglePoint> meet(const std::array<Point, 3>& corners) const;

  /// In the frame; the largest component of `direction` is 1 or -1.
  [[nodiscard]] const Point& origin() const { return in_frame_; }
  [[nodiscard]] const Point& direction() const { return direction_; }

  /// How many times `direction` leads to a distance, in the frame.
  [[nodiscard]] double way_to(double distance) const { return distance * frame_scale_ / length_; }

 private:
  /// A point from the origin of the ray; z is the way along it.
  [[nodiscard]] Point see(const Point& p) const;

  Point origin_;
  Point in_frame_;
  Point direction_;
  double length_;  // of `direction_`
  double frame_scale_;
  double scale_;  // makes what is seen about 1, from far away as well
  std::size_t main_axis_;
};

/// The first of the triangles that the ray meets and for which `counts(i, at)`.
template <class Counts>
[[nodiscard]] TriangleHit find_first_hit(const IndexView& index, const FaceTree& tree, const Ray& ray,
                                         Counts&& counts) {
  TriangleHit first;
  tree.boxes().cast(
      ray.origin(), ray.direction(), [&] { return ray.way_to(first.at.distance); },
      [&](std::size_t i) {
        const std::optional<TrianglePoint> at = ray.meet(corners_of(index, tree.triangles()[i].corners));
        if (at && precedes({i, *at}, first, tree.triangles()) && counts(i, *at)) first = {i, *at};
      });
  return first;
}

}  // namespace meshhood
