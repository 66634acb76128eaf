// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "shared/parallel.h"

namespace meshhood {

struct IndexView;

/// As without `task`, but polls `task` for cancellation. Reports no progress. Throws Error{Cancelled}.
[[nodiscard]] GraphData extract_graph(const IndexView& index, TaskContext& task);
[[nodiscard]] Fingerprint fingerprint(const Index& index, TaskContext& task);

}  // namespace meshhood
