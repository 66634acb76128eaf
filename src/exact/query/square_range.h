// SPDX-License-Identifier: MIT
#pragma once

#include "base/distance.h"
#include "base/frame.h"

namespace meshhood {

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

/// Bounds on the squared distances, as the predicate computes them, from `center` to the vertices in `sphere`.
[[nodiscard]] SquareRange squared_distances(const FrameSphere& sphere, const Center& center);

}  // namespace meshhood
