// SPDX-License-Identifier: MIT
#pragma once

#include "paper/draft.h"

namespace meshhood::paper {

/// Dissolves the clusters of `partition` that have fewer than `threshold` vertices or a single child into the clusters
/// they touch. The others are numbered in the order of their first children. A cluster that touches no other is a whole
/// component of the mesh and stays.
void fuse(const DraftLevel& below, double threshold, Partition& partition);

}  // namespace meshhood::paper
