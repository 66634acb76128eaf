// SPDX-License-Identifier: MIT
#pragma once

#include "paper/hierarchy.h"

namespace meshhood::paper {

/// Fills in what follows from the rest of a hierarchy: parents, the vertices of the clusters above the lowest level,
/// and the lowest cluster of each vertex. The hierarchy has the vertices of the clusters of the lowest level, and the
/// children of the others.
template <class Real>
void derive(Hierarchy<Real>& hierarchy);

}  // namespace meshhood::paper
