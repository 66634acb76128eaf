// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paper/create.h"
#include "paper/draft.h"

namespace meshhood::paper {

/// Chooses clusters for the next level until each cluster of `below` is the child of exactly one.
/// children: the result of `create`.
[[nodiscard]] Partition select(const DraftLevel& below, std::vector<VertexId> children);

}  // namespace meshhood::paper
