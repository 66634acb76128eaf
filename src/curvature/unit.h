// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "base/frame.h"

namespace meshhood {

/// The power of two by which coordinates are multiplied before their powers are summed. It brings `extent`, a length in
/// the frame, to between 1/2 and 1; a length below 2^-1000 stays less than that, because the factor must be finite.
[[nodiscard]] inline double unit_factor(double extent, const Frame& frame) {
  if (!(extent > 0)) return frame.scale;
  constexpr int kLargestFactorExponent = 1000;
  return std::ldexp(1.0, std::min(std::ilogb(frame.scale) - std::ilogb(extent) - 1, kLargestFactorExponent));
}

}  // namespace meshhood
