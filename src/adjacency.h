// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/adjacency.h"

#include "parallel.h"

namespace meshhood {

/// The graph of a mesh, on several threads.
[[nodiscard]] Adjacency adjacency(const MeshView& mesh, Work& work);

}  // namespace meshhood
