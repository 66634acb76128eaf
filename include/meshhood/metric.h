// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "meshhood/export.h"

namespace meshhood MESHHOOD_API {

/// How the distance of a vertex is measured, of which radii and smoothing kernels speak. See `Searcher`.
enum class Metric : std::uint8_t {
  Straight,  ///< what is connected within the ball, and straight lines
  Path,      ///< what is within the radius along the edges, and the lengths of shortest paths
  Rings,     ///< what at most `radius` edges, rounded down, separate from a vertex, and numbers of edges
  Space,     ///< what is within the radius in space, connected or not, and straight lines
};

}  // namespace meshhood
