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

inline PositionsView view_positions(const void* xyz, std::size_t scalars, bool is_double) {
  if (is_double) return std::span(static_cast<const double*>(xyz), scalars);
  return std::span(static_cast<const float*>(xyz), scalars);
}

inline IndicesView view_indices(const void* indices, std::size_t count, bool is_signed) {
  if (is_signed) return std::span(static_cast<const std::int32_t*>(indices), count);
  return std::span(static_cast<const std::uint32_t*>(indices), count);
}

/// `offset_count` is 0 for triangles.
inline FacesView view_faces(const void* corners, std::size_t corner_count, bool signed_corners, const void* offsets,
                            std::size_t offset_count, bool signed_offsets) {
  const IndicesView corner_view = view_indices(corners, corner_count, signed_corners);
  if (offset_count == 0) return FacesView::triangles(corner_view);
  return FacesView::polygons(view_indices(offsets, offset_count, signed_offsets), corner_view);
}

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
