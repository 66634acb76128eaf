// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace meshhood {

/// A vertex, by its row in the caller's positions.
using VertexId = std::uint32_t;

/// An index into a list of neighbors, in which each edge occurs twice.
using EdgeOffset = std::uint32_t;

}  // namespace meshhood
