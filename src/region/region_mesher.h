// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"
#include "meshhood/region_mesh.h"

#include "shared/distance.h"

namespace meshhood {

/// The corners of each face, and the faces of each vertex.
class FaceLists {
 public:
  /// The mesh must be valid.
  explicit FaceLists(const MeshView& mesh);

  /// #F.
  [[nodiscard]] std::size_t size() const { return corner_begin_.size() - 1; }

  [[nodiscard]] std::span<const VertexId> corners(std::size_t face) const {
    return std::span(corners_).subspan(corner_begin_[face], corner_begin_[face + 1] - corner_begin_[face]);
  }

  /// The faces that have the vertex as a corner, ascending; twice if it is two corners of one.
  [[nodiscard]] std::span<const std::size_t> faces(VertexId v) const {
    return std::span(faces_).subspan(face_begin_[v], face_begin_[v + 1] - face_begin_[v]);
  }

 private:
  std::vector<std::uint64_t> corner_begin_;
  std::vector<VertexId> corners_;
  std::vector<std::uint64_t> face_begin_;
  std::vector<std::size_t> faces_;
};

struct RegionMesher::State {
  PositionsView positions;
  FaceLists lists;
  std::vector<std::uint32_t> marks;  // by vertex: the last call that had it among its ids
  std::uint32_t round = 0;

  explicit State(const MeshView& mesh) : positions(mesh.positions), lists(mesh), marks(mesh.positions.size()) {}

  /// Throws Error{VertexOutOfRange}.
  void mark(std::span<const VertexId> ids);
  [[nodiscard]] bool is_marked(VertexId v) const { return marks[v] == round; }

  /// Marks the ids, and returns the faces that belong to them, ascending.
  std::vector<std::size_t> select(std::span<const VertexId> ids, Corners corners);
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

/// The point of the rim on each of `edges`. Throws as `RegionMesher::rim`.
[[nodiscard]] std::vector<SpacePoint> rim_points(const PositionsView& positions, std::span<const RimEdge> edges,
                                                 const SpacePoint& center, double radius);

/// Where the segment from `inside`, a point of the ball, to `outside` leaves the ball; `outside` if that is inside too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

}  // namespace meshhood
