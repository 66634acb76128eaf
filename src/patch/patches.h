// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "meshhood/batch.h"
#include "meshhood/patch.h"
#include "meshhood/run.h"

#include "patch/search.h"

namespace meshhood {

/// The nearest point within `radius` of the center of the last run of `search` on a triangle that it has not reached.
[[nodiscard]] SurfacePoint find_gap(const PatchState& state, const PatchSearch& search, double radius);

/// The patch of the last run of `search`, which was given `radius`, as a mesh, without its area.
[[nodiscard]] ClippedMesh clip_patch(const PatchState& state, const PatchSearch& search, double radius,
                                     double tolerance);

/// The patch of a row, as a search has found it.
struct FoundPatch {
  const PatchState& state;
  const PatchSearch& search;
  double radius;
  bool exists;

  [[nodiscard]] SurfacePoint gap() const { return exists ? find_gap(state, search, radius) : SurfacePoint{}; }
};

/// Calls `visit` with the patch of each row, on any thread; `place` is that of the row in a result #radii by #rows.
/// Throws as `invariants`.
void for_each_patch(const Surface& surface, const BatchQuery& query, bool measures, const Run& run,
                    const std::function<void(std::size_t place, const FoundPatch& patch)>& visit);

}  // namespace meshhood
