// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "meshhood/error.h"

#include "shared/distance.h"
#include "shared/text.h"

namespace meshhood {

[[nodiscard]] inline bool is_valid_coordinate(double coordinate) { return std::abs(coordinate) <= kLargestCoordinate; }

/// Throws Error{InvalidMesh}, naming vertex `v`, unless its coordinates are finite and at most 2^500 in magnitude.
inline void check_position(std::size_t v, const Point& p) {
  if (is_valid_coordinate(p.x) && is_valid_coordinate(p.y) && is_valid_coordinate(p.z)) [[likely]] {
    return;
  }
  const auto refuse = [v](char axis, double value) {
    raise(ErrorCode::InvalidMesh, "vertex " + std::to_string(v) + ": " + axis + " is " + to_text(value) +
                                      ", expected a finite number of at most 2^500 in magnitude");
  };
  if (!is_valid_coordinate(p.x)) refuse('x', p.x);
  if (!is_valid_coordinate(p.y)) refuse('y', p.y);
  refuse('z', p.z);
}

}  // namespace meshhood
