// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/batch.h"

namespace meshhood::wasm {

/// The rows of a call on many vertices, their radii and metric. `search_by` sets the metric, and `use_rows` the rest,
/// which borrows its arrays for the call that follows.
inline BatchQuery rows;

}  // namespace meshhood::wasm
