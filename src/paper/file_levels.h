// SPDX-License-Identifier: MIT
#pragma once

#include "paper/hierarchy.h"

namespace meshhood::paper {

/// Fills in what a hierarchy need not be told: of `levels` it has the spheres, the siblings, and the vertices of the
/// lowest or the children of the others.
template <class Real>
void complete(Hierarchy<Real>& hierarchy);

}  // namespace meshhood::paper
