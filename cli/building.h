// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/index.h"
#include "meshhood/paper.h"

namespace meshhood::cli {

/// As many as the processor has.
inline constexpr unsigned kAllThreads = 0;

/// Builds an index of a `MeshView` or a `GraphView`, with progress for the impatient; the exact one by as many threads
/// as `BuildOptions` says.
template <class Mesh>
[[nodiscard]] Index build_exact_index(const Mesh& mesh, unsigned threads);
template <class Mesh>
[[nodiscard]] paper::Index build_paper_index(const Mesh& mesh);

}  // namespace meshhood::cli
