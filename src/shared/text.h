// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// Returns the shortest text that reads back as `value`.
[[nodiscard]] inline std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

/// Returns index `i` as it was given, with its sign.
[[nodiscard]] inline std::string to_text(const IndicesView& indices, std::size_t i) {
  return indices.visit([i](auto all) { return std::to_string(all[i]); });
}

/// Throws Error{code} about a vertex that the mesh does not have. `where` says what named it, as in `edge 3: vertex `,
/// and `vertex` is its number as it was given, with its sign.
[[noreturn]] inline void raise_no_such_vertex(ErrorCode code, std::string_view where, std::string_view vertex,
                                              std::size_t vertices) {
  raise(code, std::string(where).append(vertex) + ", but the mesh has " + std::to_string(vertices) + " vertices");
}

/// Throws Error{InvalidOption} if an argument that is called back is empty.
template <class Function>
void check_function(const Function& function, const char* name) {
  if (!function) raise(ErrorCode::InvalidOption, std::string(name) + " is empty, expected a function");
}

/// Throws Error{InvalidMesh}, naming vertex `v` and the first of its coordinates that is not valid. The message begins
/// with `where`.
[[noreturn]] inline void refuse_position(std::uint64_t v, const Point& p, std::string_view where = {}) {
  const auto [axis, coordinate] = !is_valid_coordinate(p.x)   ? std::pair('x', p.x)
                                  : !is_valid_coordinate(p.y) ? std::pair('y', p.y)
                                                              : std::pair('z', p.z);
  raise(ErrorCode::InvalidMesh, std::string(where) + "vertex " + std::to_string(v) + ": " + axis + " is " +
                                    to_text(coordinate) + ", expected a finite number of at most 2^500 in magnitude");
}

/// Returns the beginning of a message: an argument, and the row of it.
[[nodiscard]] inline std::string named(std::string_view name, std::optional<std::size_t> row) {
  return std::string(name) + (row ? ": row " + std::to_string(*row) + ": " : ": ");
}

/// Throws Error{InvalidOption}, naming the coordinate of a point that is not finite or too large, and the argument by
/// `name` and `row`.
inline void check_point(const std::array<double, 3>& p, std::string_view name, std::optional<std::size_t> row = {}) {
  for (std::size_t axis = 0; axis < p.size(); ++axis) {
    if (is_valid_coordinate(p[axis])) continue;
    raise(ErrorCode::InvalidOption, named(name, row) + "coordinate " + std::to_string(axis) + " is " +
                                        to_text(p[axis]) + ", expected a finite number of magnitude up to 2^500");
  }
}

}  // namespace meshhood::inline v0_1
