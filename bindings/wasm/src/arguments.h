// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"

/// Arguments as JavaScript passes them: an address and a number of elements for each array, numbers as double.
namespace meshhood::wasm {

inline std::span<const std::byte> view_bytes(const void* data, std::size_t size) {
  return {static_cast<const std::byte*>(data), size};
}

/// The mesh, the faces or the positions of the call that follows, as `take_positions` and `take_faces` have left them.
/// Borrows the arrays.
inline MeshView given;

/// The rows of a call on many vertices, their radii and metric. `search_by` sets the metric, and `use_rows` the rest,
/// which borrows its arrays for the call that follows.
inline BatchQuery rows;

/// All vertices if `vertices` is null.
inline BatchVertices view_vertices(const VertexId* vertices, std::size_t count) {
  if (vertices == nullptr) return {};
  const std::span list(vertices, count);
  return list;
}

/// `number` is a whole number >= 0, as JavaScript has checked. Those of more than 32 bits become the largest.
inline std::size_t to_size(double number) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  return number < kMost ? static_cast<std::size_t>(number) : kMost;
}

}  // namespace meshhood::wasm
