// SPDX-License-Identifier: MIT
#pragma once

#include "patch/clipped_triangle.h"
#include "patch/rim.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// Area and volume of the patch around the center of a ball, from its parts.
///
/// The volume behind a patch is (sum of d A + r S) / 3, by the divergence theorem: d is the distance of a triangle's
/// plane from the center, along its normal, A the area of its part in the ball, S that of the part of the sphere
/// behind. The sum of d A over a meshlet is linear in the center.
class PatchSums {
 public:
  /// Begins with a patch whose normal is about this one, of any length.
  void clear(const Point& normal);

  /// Triangles in the ball: the sums of area and of area times distance, in the frame.
  void add_whole(double area, double moment) {
    area_ += area;
    moment_ += moment;
  }

  /// The part of a triangle that is not, `area` and `distance` in units of the radius. The caller adds its arcs to
  /// `rim`.
  void add_cut(double area, double distance, const PatchBall& ball);
  /// The same, with its arcs.
  void add_cut(ClippedTriangle& clipped, const PatchBall& ball);

  [[nodiscard]] RimArcs& rim() { return rim_; }

  void meet_border() { has_border_ = true; }

  /// In the unit of the mesh.
  [[nodiscard]] double area(const PatchBall& ball) const;

  /// NaN if a border is in the ball. Of a patch, which has a triangle.
  [[nodiscard]] double volume(const PatchBall& ball) const;

 private:
  RimArcs rim_;
  bool has_border_ = false;
  double area_ = 0;    // these two in the frame
  double moment_ = 0;  // the sum of area times distance
};

}  // namespace meshhood::inline v0_1
