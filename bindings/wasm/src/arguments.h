// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "meshhood/batch.h"
#include "meshhood/mesh.h"

/// Arguments as JavaScript passes them: an address and a number of elements for each array, numbers as double, and
/// sizes, which it has checked, with 32 bits.
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

}  // namespace meshhood::wasm
