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
  /// Borrows the index and the faces, of which `tree` is.
  PatchState(const IndexView& given, const StoredFaces& all, const FaceTree& tree)
      : index(&given), faces(&all), triangles(given, tree), clusters(given, triangles) {}

  const IndexView* index;
  const StoredFaces* faces;
  Triangles triangles;
  Clusters clusters;

  [[nodiscard]] std::size_t bytes() const { return triangles.bytes() + clusters.bytes(); }
};

}  // namespace meshhood
