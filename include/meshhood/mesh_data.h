// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A polygonal mesh that owns its arrays: a copy of a mesh of another library (see cgal.h, openmesh.h and
/// geometry_central.h), or a mesh of a file.
struct MeshData {
  PositionsData positions;             ///< #V by 3
  std::vector<std::uint64_t> offsets;  ///< #F + 1 (see `FacesView::polygons`), or empty if every face is a triangle
  std::vector<std::uint32_t> corners;  ///< of all faces, face after face

  /// Borrows from this object. A view of a temporary does not compile.
  [[nodiscard]] MeshView view() const& {
    return {std::visit([](const auto& xyz) { return PositionsView(xyz); }, positions),
            offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(offsets, corners)};
  }
  [[nodiscard]] MeshView view() const&& = delete;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
