// SPDX-License-Identifier: MIT
#pragma once

#include "base/frame.h"
#include "shared/distance.h"
#include "simd/ball.h"

/// Bounds on the distances from a center that need not be a vertex, and may be far away from the mesh.
namespace meshhood::inline v0_1 {

/// Bounds on squared distances.
struct SquareRange {
  double low;
  double high;
};

/// The point from which distances are measured, in the coordinates of the mesh and of its frame.
struct Center {
  Point exact;
  Point in_frame;
  double unit;  // the length of a unit of the frame

  Center(const Frame& frame, const Point& p) : exact(p), in_frame(frame.to_frame(p)), unit(1 / frame.scale) {}
};

/// Returns bounds on the squared distances, as the predicate computes them, from `center` to the vertices in `sphere`.
[[nodiscard]] SquareRange squared_distances(const FrameSphere& sphere, const Center& center);

/// Returns a ball to be compared with vertices, whose center need not be a vertex: `LeafBall` by itself assumes that
/// the center is exact in single precision where the positions are floats.
[[nodiscard]] LeafBall any_ball(const Point& center, double radius);

}  // namespace meshhood::inline v0_1
