// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood::inline v0_1 {

/// The faces of a mesh as index files and surfaces have them.
struct StoredFaces {
  std::span<const VertexId> corners;       // of all faces, face after face
  std::span<const std::uint32_t> offsets;  // as in `FacesView::polygons`; empty if all faces are triangles

  /// Returns #F.
  [[nodiscard]] std::size_t size() const { return offsets.empty() ? corners.size() / 3 : offsets.size() - 1; }

  [[nodiscard]] std::span<const VertexId> operator[](std::size_t face) const {
    if (offsets.empty()) return corners.subspan(3 * face, 3);
    return corners.subspan(offsets[face], offsets[face + 1] - offsets[face]);
  }

  [[nodiscard]] FacesView view() const {
    return offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(offsets, corners);
  }
};

/// Owns the arrays of stored faces.
struct FaceArrays {
  std::vector<VertexId> corners;
  std::vector<std::uint32_t> offsets;
};

/// Makes the arrays, which are the same for the same faces, however `faces` represents them. `faces` must have passed
/// `validate`. Throws Error{TooLarge} if an offset has more than 32 bits. O(#corners).
[[nodiscard]] FaceArrays make_face_arrays(const FacesView& faces);

}  // namespace meshhood::inline v0_1
