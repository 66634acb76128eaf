// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "meshhood/patch.h"

#include "exact/bound_index.h"
#include "patch/clusters.h"
#include "patch/triangles.h"

namespace meshhood {

/// What all searches of a surface share.
struct PatchIndex::State {
  State(const Index& given, const FacesView& faces)
      : index(given), triangles(*index, faces), clusters(*index, triangles) {}

  BoundIndex index;
  Triangles triangles;
  Clusters clusters;

  [[nodiscard]] std::size_t face_count() const { return triangles.first_of_face.size() - 1; }
};

struct PatchAccess {
  using State = PatchIndex::State;

  [[nodiscard]] static const std::shared_ptr<const State>& share(const PatchIndex& surface) {
    return surface.state_.share();
  }
};

using PatchState = PatchAccess::State;

}  // namespace meshhood
