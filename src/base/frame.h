// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "meshhood/mesh.h"

#include "base/vector.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

class TaskContext;

/// A point in the coordinates of a `Frame`.
struct FramePoint {
  float x;
  float y;
  float z;
};

/// A sphere in the coordinates of a `Frame`.
using FrameSphere = Sphere<float>;

/// Coordinates in which every vertex lies in [-1, 1]^3, whatever the unit of the positions. The tree stores floats,
/// which rounds a vertex by at most 2^-25 along each axis.
struct Frame {
  Point origin{0, 0, 0};
  double scale = 1;  // a power of two, so that scaling does not round

  [[nodiscard]] Point to_frame(const Point& p) const {
    return {(p.x - origin.x) * scale, (p.y - origin.y) * scale, (p.z - origin.z) * scale};
  }

  [[nodiscard]] Point from_frame(const Point& p) const { return origin + (1 / scale) * p; }

  [[nodiscard]] FramePoint round(const Point& p) const {
    const Point q = to_frame(p);
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
  }
};

/// Returns whether `p` lies in the cube of the frame, [-1, 1]^3.
[[nodiscard]] inline bool covers(const Frame& frame, const Point& p) {
  const Point q = frame.to_frame(p);
  return std::abs(q.x) <= 1 && std::abs(q.y) <= 1 && std::abs(q.z) <= 1;
}

/// Returns whether squares of distances in the mesh of the frame may underflow.
[[nodiscard]] inline bool may_squares_underflow(const Frame& frame) { return frame.scale > 0x1p480; }

/// Returns the frame centered at the bounding box of the positions, which must be valid.
[[nodiscard]] Frame make_frame(const PositionsView& positions);
[[nodiscard]] Frame make_frame(const PositionsView& positions, TaskContext& task);

/// Returns a float greater than `value`: the one after the nearest.
[[nodiscard]] inline float next_above(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

}  // namespace meshhood::inline v0_1
