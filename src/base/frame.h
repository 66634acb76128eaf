// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/mesh.h"

#include "base/distance.h"

namespace meshhood {

/// A point and a sphere in the coordinates of a `Frame`.
struct FramePoint {
  float x;
  float y;
  float z;
};

struct FrameSphere {
  float x;
  float y;
  float z;
  float radius;
};

/// Coordinates in which every vertex lies in [-1, 1]: what the tree is kept in, as floats, whatever the unit and the
/// precision of the positions. A vertex is rounded by at most 2^-25 along each axis.
struct Frame {
  Point origin{0, 0, 0};
  double scale = 1;  // a power of two, so that lengths are scaled without rounding

  [[nodiscard]] Point to_frame(const Point& p) const {
    return {(p.x - origin.x) * scale, (p.y - origin.y) * scale, (p.z - origin.z) * scale};
  }

  [[nodiscard]] FramePoint round(const Point& p) const {
    const Point q = to_frame(p);
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
  }
};

/// The frame of valid positions.
[[nodiscard]] Frame make_frame(const PositionsView& positions);

}  // namespace meshhood
