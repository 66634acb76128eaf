// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "surface/surface.h"

namespace meshhood::inline v0_1 {

/// A set of vertices, and the faces that belong to it.
class FaceSelection {
 public:
  /// Throws Error{VertexOutOfRange}.
  FaceSelection(const SurfaceState& surface, std::span<const VertexId> ids, Corners corners);

  [[nodiscard]] bool has(VertexId v) const { return is_marked_[v]; }
  [[nodiscard]] const std::vector<std::size_t>& faces() const { return faces_; }  // ascending

 private:
  std::vector<bool> is_marked_;
  std::vector<std::size_t> faces_;
};

/// Where the segment from `inside`, a point of the ball, to `outside` leaves the ball; `outside` if that is inside too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

}  // namespace meshhood::inline v0_1
