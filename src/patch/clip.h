// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/patch.h"

#include "patch/search.h"
#include "patch/state.h"

namespace meshhood {

/// The patch of the last run of `search`, which was given `radius`, as a mesh, without its area.
[[nodiscard]] ClippedMesh clip_patch(const PatchState& state, const PatchSearch& search, double radius,
                                     double tolerance);

}  // namespace meshhood
