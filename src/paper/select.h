// SPDX-License-Identifier: MIT
#pragma once

#include "paper/create.h"
#include "paper/draft.h"

namespace meshhood::paper {

/// Chooses clusters for the next level until every cluster of `below` is the child of exactly one.
/// children: as `create` gives them.
[[nodiscard]] Partition select(const DraftLevel& below, std::vector<VertexId> children);

}  // namespace meshhood::paper
