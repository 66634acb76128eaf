// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/patch.h"

#include "patch/search.h"
#include "patch/state.h"

namespace meshhood {

/// The nearest point within `radius` of the center of the last run of `search` on a triangle that it has not reached.
[[nodiscard]] SurfacePoint find_gap(const PatchState& state, const PatchSearch& search, double radius);

}  // namespace meshhood
