// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "meshhood/error.h"
#include "meshhood/mesh.h"

#include "shared/distance.h"
#include "shared/parallel.h"
#include "shared/text.h"

namespace meshhood::inline v0_1 {

[[nodiscard]] inline bool is_valid_coordinate(double coordinate) { return std::abs(coordinate) <= kLargestCoordinate; }

/// Returns whether the coordinates are finite and at most 2^500 in magnitude.
[[nodiscard]] inline bool is_valid_position(const Point& p) {
  return is_valid_coordinate(p.x) && is_valid_coordinate(p.y) && is_valid_coordinate(p.z);
}

/// Throws Error{InvalidMesh}, naming vertex `v` and the first of its coordinates that is not valid.
[[noreturn]] inline void refuse_position(std::size_t v, const Point& p) {
  const auto [axis, coordinate] = !is_valid_coordinate(p.x)   ? std::pair('x', p.x)
                                  : !is_valid_coordinate(p.y) ? std::pair('y', p.y)
                                                              : std::pair('z', p.z);
  raise(ErrorCode::InvalidMesh, "vertex " + std::to_string(v) + ": " + axis + " is " + to_text(coordinate) +
                                    ", expected a finite number of at most 2^500 in magnitude");
}

/// Validate as the public functions do, with the same errors, but on several threads. They also throw Error{Cancelled}.
void validate(const PositionsView& positions, TaskContext& task);
void validate(const MeshView& mesh, TaskContext& task);

}  // namespace meshhood::inline v0_1
