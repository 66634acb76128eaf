// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "surface/surface.h"

namespace meshhood {

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

/// An edge that leaves a region: its end inside, and its end outside.
using RimEdge = std::array<VertexId, 2>;

/// Calls `f(begin, count)` for each run of `count` corners inside the region, the first of which is corner `begin`;
/// corners are numbered around the face. None if all are inside.
template <class IsInside, class F>
void for_each_run(std::span<const VertexId> corners, IsInside&& is_inside, F&& f) {
  const std::size_t size = corners.size();
  for (std::size_t begin = 0; begin < size; ++begin) {
    if (is_inside(corners[(begin + size - 1) % size]) || !is_inside(corners[begin])) continue;
    std::size_t count = 1;
    while (is_inside(corners[(begin + count) % size])) ++count;
    f(begin, count);
  }
}

/// The point of the rim on each of `edges`. Throws as `Surface::rim`.
[[nodiscard]] std::vector<SpacePoint> rim_points(const IndexView& index, std::span<const RimEdge> edges,
                                                 const SpacePoint& center, double radius);

/// Where the segment from `inside`, a point of the ball, to `outside` leaves the ball; `outside` if that is inside too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

}  // namespace meshhood
