// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/region_mesh.h"

#include "region/face_lists.h"
#include "shared/distance.h"

namespace meshhood {

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

/// Where the segment from `inside`, a point of the ball, to `outside` leaves the ball; `outside` if that is inside too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

}  // namespace meshhood
