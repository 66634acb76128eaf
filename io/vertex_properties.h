// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "io/mesh_io.h"

namespace meshhood::inline v0_1::io {

/// The numbers of a property for each vertex: 1, or 3 of a vector. `property` has been checked.
[[nodiscard]] inline std::size_t components(const VertexProperty& property, std::size_t vertices) {
  return property.values.size() == vertices ? 1 : 3;
}

/// Throws Error{InvalidOption} if a name is not printable ASCII without blanks, occurs twice or is one of `taken`, or
/// if the values are not those of `vertices`.
void check_properties(std::span<const VertexProperty> properties, std::size_t vertices,
                      std::vector<std::string_view> taken = {});

/// Throws Error{InvalidOption} unless `walls` is empty or has a value for each vertex, and Error{InvalidMesh} if a face
/// has one of them.
void check_walls(std::span<const std::uint8_t> walls, const MeshView& mesh);

/// A coordinate as it is written. `walls` has been checked.
template <class Real>
[[nodiscard]] Real written(const StridedPositions<Real>& xyz, std::size_t vertex, std::size_t axis,
                           std::span<const std::uint8_t> walls) {
  const bool is_placed = walls.empty() || walls[vertex] == 0;
  return is_placed ? xyz(vertex, axis) : std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace meshhood::inline v0_1::io
