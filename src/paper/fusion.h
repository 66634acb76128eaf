// SPDX-License-Identifier: MIT
#pragma once

#include "paper/draft.h"

namespace meshhood::paper {

/// Dissolves the clusters of `partition` with fewer than `threshold` vertices, or with a single child, into those they
/// touch; what is left is numbered in the order of the first child. A cluster that touches none, being a whole
/// component of the mesh, is kept as it is.
void fuse(const DraftLevel& below, double threshold, Partition& partition);

}  // namespace meshhood::paper
