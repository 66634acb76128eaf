// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "io/mesh_io.h"

namespace meshhood::io {

/// The numbers of a property for each vertex: 1, or 3 of a vector. `property` has been checked.
[[nodiscard]] inline std::size_t components(const VertexProperty& property, std::size_t vertices) {
  return property.values.size() == vertices ? 1 : 3;
}

/// Throws Error{InvalidOption} if a name is not printable ASCII without blanks, occurs twice or is one of `taken`, or
/// if the values are not those of `vertices`.
void check_properties(std::span<const VertexProperty> properties, std::size_t vertices,
                      std::vector<std::string_view> taken = {});

}  // namespace meshhood::io
