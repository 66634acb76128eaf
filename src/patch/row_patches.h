// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "meshhood/patch.h"

#include "batch/rows.h"
#include "patch/gap.h"
#include "patch/search.h"
#include "patch/state.h"

namespace meshhood {

class TaskContext;

/// The patch of a row of a batch, while it is visited.
struct RowPatch {
  std::size_t row;
  double radius;
  const PatchState& state;
  const PatchSearch& search;
  bool exists;

  [[nodiscard]] SurfacePoint gap() const { return exists ? find_gap(state, search, radius) : SurfacePoint{}; }
};

/// Calls `visit` after a search for each row, on any thread.
void for_each_patch(const PatchState& state, const Rows& rows, TaskContext& task, bool measures,
                    const std::function<void(const RowPatch&)>& visit);

}  // namespace meshhood
