// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "base/parallel.h"

namespace meshhood {

/// As `extract_graph(index)`. Who watches the work is asked now and then whether to go on, and told of no progress.
/// Throws Error{Cancelled}.
[[nodiscard]] GraphData extract_graph(const Index& index, TaskContext& task);

}  // namespace meshhood
