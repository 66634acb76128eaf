// SPDX-License-Identifier: MIT
// Found instead of the installed header: ids of 16 bits, so that tiny meshes reach every limit on vertices and edges.
#pragma once

#include <cstdint>
#include <limits>

namespace meshhood::inline v0_1 {

using VertexId = std::uint16_t;

/// No vertex.
inline constexpr VertexId kNoVertex = std::numeric_limits<VertexId>::max();

using EdgeOffset = std::uint16_t;

}  // namespace meshhood::inline v0_1
