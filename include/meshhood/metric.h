// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace meshhood {

/// How the distance of a vertex is measured, of which radii and smoothing kernels speak.
enum class Metric : std::uint8_t {
  Straight,  ///< the exact neighborhood (see `Searcher`), and straight lines
  Path,      ///< the vertices within the radius along the edges (see `EdgeSearcher`), and the lengths of shortest paths
  Rings,     ///< the vertices that at most `radius` edges, rounded down, separate from one, and numbers of edges
};

}  // namespace meshhood
