// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "parallel.h"

namespace meshhood {

/// As `graph(index)`. Who watches the work is asked now and then whether to go on, and told of no progress.
/// Throws Error{Cancelled}.
[[nodiscard]] GraphData graph(const Index& index, Work& work);

}  // namespace meshhood
