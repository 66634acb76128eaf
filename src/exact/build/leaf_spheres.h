// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "exact/build/tree.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood {

/// The bounding spheres of some leaves, or of all places for leaves. A leaf without vertices has an empty sphere.
/// `index` has the frame, the positions and the leaves. O(#V) of the leaves.
[[nodiscard]] Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task);
[[nodiscard]] Spheres measure_leaves(const IndexView& index, TaskContext& task);

}  // namespace meshhood
