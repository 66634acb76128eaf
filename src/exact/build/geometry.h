// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "meshhood/mesh.h"

#include "exact/arrays.h"
#include "exact/build/tree.h"
#include "exact/layout.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// The steps that `make_geometry` reports: positions, leaves, tree.
inline constexpr std::size_t kGeometrySteps = 3;

/// The last part of a build, and all of a `refit`: the positions in index order, the bounds of the leaves and the tree.
///
/// positions     valid, in the caller's order
/// connectivity  a view of all that does not depend on the positions
/// geometry      has the frame, and the leaves without their bounds; the rest is filled
/// O(#V).
void make_geometry(const PositionsView& positions, const IndexView& connectivity, GeometryData& geometry,
                   TaskContext& task);

/// The same from the positions in `geometry`, in index order.
void measure_geometry(const IndexView& connectivity, GeometryData& geometry, TaskContext& task);

/// The bounding spheres of some leaves, or of all places for leaves. A leaf without vertices has an empty sphere.
/// `index` has the frame, the positions and the leaves. O(#V) of the leaves.
[[nodiscard]] Spheres measure_leaves(std::span<const LeafId> leaves, const IndexView& index, TaskContext& task);
[[nodiscard]] Spheres measure_leaves(const IndexView& index, TaskContext& task);

}  // namespace meshhood::inline v0_1
