// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshhood/mesh.h"

namespace meshhood {

/// The faces of a mesh as an index file stores them.
struct StoredFaces {
  std::span<const std::uint32_t> corners;  // of all faces, face after face
  std::span<const std::uint32_t> offsets;  // as in `FacesView::polygons`; empty if all faces are triangles

  [[nodiscard]] FacesView view() const {
    return offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(offsets, corners);
  }
};

/// The arrays of stored faces.
struct FaceArrays {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> offsets;
};

/// The same faces have the same arrays, however `faces` represents them. `faces` must have passed `validate`.
/// Throws Error{TooLarge} if an offset has more than 32 bits. O(#corners).
[[nodiscard]] FaceArrays make_face_arrays(const FacesView& faces);

}  // namespace meshhood
