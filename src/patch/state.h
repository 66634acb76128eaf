// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "patch/clusters.h"
#include "patch/triangles.h"

namespace meshhood {

/// What all searches of the patches of a surface share. The walls of the index are left out.
struct PatchState {
  /// Borrows the index.
  PatchState(const IndexView& given, const FacesView& faces)
      : index(&given), triangles(given, faces), clusters(given, triangles) {}

  const IndexView* index;
  Triangles triangles;
  Clusters clusters;

  [[nodiscard]] std::size_t face_count() const { return triangles.first_of_face.size() - 1; }
  [[nodiscard]] std::size_t bytes() const { return triangles.bytes() + clusters.bytes(); }
};

}  // namespace meshhood
