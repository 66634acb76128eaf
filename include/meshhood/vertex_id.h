// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__cpp_concepts) || __cpp_concepts < 201907L
#error "meshhood needs C++20: compile with -std=c++20"
#endif

#include <cstdint>
#include <limits>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// A vertex, by its row in the caller's positions.
using VertexId = std::uint32_t;

/// No vertex.
inline constexpr VertexId kNoVertex = (std::numeric_limits<VertexId>::max)();

/// An index into a list of neighbors, in which each edge occurs twice.
using EdgeOffset = std::uint32_t;

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
