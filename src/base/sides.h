// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/mesh.h"

namespace meshhood {

/// Calls `f(v, w)` for every pair of consecutive distinct corners of the polygons `begin .. end - 1`, the last with the
/// first. A side that several polygons share is repeated. The polygons must be valid.
template <class F>
void for_each_side(const FacesView& faces, std::size_t begin, std::size_t end, F&& f) {
  faces.for_each(begin, end, [&](std::size_t, std::span<const VertexId> corners) {
    if (corners.empty()) return;
    VertexId previous = corners.back();
    for (const VertexId corner : corners) {
      if (corner != previous) f(previous, corner);
      previous = corner;
    }
  });
}

}  // namespace meshhood
