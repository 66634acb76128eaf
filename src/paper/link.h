// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "paper/draft.h"
#include "paper/hierarchy.h"

namespace meshhood::paper {

/// Computes the next level: vertices and siblings of each cluster, from those of its children.
[[nodiscard]] DraftLevel link(const DraftLevel& below, const Partition& partition);

/// Computes the bounding sphere of each cluster of `level`, and the mean radius of the level.
/// positions: in index order, #V by 3.
template <class Real>
void enclose(std::span<const Real> positions, Level<Real>& level);

/// The mean radius of the spheres of `level`; 0 if it has none.
template <class Real>
[[nodiscard]] double mean_radius(const Level<Real>& level);

}  // namespace meshhood::paper
