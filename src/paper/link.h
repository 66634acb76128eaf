// SPDX-License-Identifier: MIT
#pragma once

#include "paper/draft.h"
#include "paper/hierarchy.h"

namespace meshhood::paper {

/// The next level: vertices and siblings of each cluster, from those of its children.
[[nodiscard]] DraftLevel link(const DraftLevel& below, const Partition& partition);

/// Gives every cluster of `level` its bounding sphere, and the level its mean radius.
/// positions: in index order, `#V by 3`.
template <class Real>
void enclose(std::span<const Real> positions, Level<Real>& level);

/// The mean radius of the spheres of `level`, which stand; 0 where there is none.
template <class Real>
[[nodiscard]] double mean_radius(const Level<Real>& level);

}  // namespace meshhood::paper
