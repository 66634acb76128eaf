// SPDX-License-Identifier: MIT
#include "simd/ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshhood::inline v0_1 {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max();

/// Returns the largest float <= `value`.
float round_down(double value) {
  if (std::isinf(value)) return static_cast<float>(value);
  const auto rounded = static_cast<float>(std::clamp(value, -kLargest, kLargest));
  return static_cast<double>(rounded) > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                                              : rounded;
}

/// Returns the smallest float >= `value`.
float round_up(double value) { return -round_down(-value); }

// These bound the error of a squared distance in single precision. Float coordinates are exact, so a difference has a
// relative error of 2^-24, a square of three times that, and the two sums add twice 2^-24: 5 * 2^-24 in total. Products
// below the smallest float add at most 2^-149 each.
constexpr double kFloatError = 0x1p-21;
constexpr double kFloatUnderflow = 0x1p-140;

// The center and the points that the spheres enclose are rounded by 2^-25 along each axis; the radii of the spheres
// include that. The comparison rounds by at most 2^-22 of either radius; spheres and ball each have room for 2^-20.
constexpr double kTreeError = 0x1p-20;

// Where squares underflow in the predicate, vertices that are too far away count as inside; see `SearchBall`.
constexpr double kTiny = 0x1p-500;

}  // namespace

LeafBounds::LeafBounds(double radius)
    : squared_radius(meshhood::squared_radius(radius)),
      surely_inside(round_down(squared_radius * (1 - kFloatError) - kFloatUnderflow)),
      surely_outside(round_up(squared_radius * (1 + kFloatError) + kFloatUnderflow)) {}

TreeBounds::TreeBounds(const Frame& frame, double radius)
    : outer(round_up((radius * (1 + kTreeError) + kTiny) * frame.scale)),
      inner(round_down((radius * (1 - kTreeError) - kTiny) * frame.scale)) {}

}  // namespace meshhood::inline v0_1
