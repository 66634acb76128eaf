// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "base/parallel.h"

namespace meshhood {

/// The same as without `task`, which it polls for cancellation; reports no progress. Throws Error{Cancelled}.
[[nodiscard]] GraphData extract_graph(const Index& index, TaskContext& task);
[[nodiscard]] Fingerprint fingerprint(const Index& index, TaskContext& task);

}  // namespace meshhood
