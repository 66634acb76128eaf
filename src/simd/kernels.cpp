// SPDX-License-Identifier: MIT
#include "simd/kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshhood {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max();

/// The largest float <= `value`.
float round_down(double value) {
  if (std::isinf(value)) return static_cast<float>(value);
  const auto rounded = static_cast<float>(std::clamp(value, -kLargest, kLargest));
  return static_cast<double>(rounded) > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                                              : rounded;
}

/// The smallest float >= `value`.
float round_up(double value) { return -round_down(-value); }

// The coordinates are floats, so a difference is off by 2^-24 of itself, a square by three times that, and the two sums
// by two more: 5 * 2^-24 in all. Products below the smallest float add at most 2^-149 each.
constexpr double kFloatError = 0x1p-21;
constexpr double kFloatUnderflow = 0x1p-140;

// The centre and the spheres' points are rounded by 2^-25 along each axis, which the radius of a sphere makes up for;
// so are the roundings of the comparison, 2^-22 of either radius at most, by 2^-20 of each.
constexpr double kTreeError = 0x1p-20;

// Where squares underflow in the predicate, vertices that are too far count as inside. See SearchBall.
constexpr double kTiny = 0x1p-500;

}  // namespace

LeafBounds::LeafBounds(double radius)
    : squared_radius(meshhood::squared_radius(radius)),
      surely_inside(round_down(squared_radius * (1 - kFloatError) - kFloatUnderflow)),
      surely_outside(round_up(squared_radius * (1 + kFloatError) + kFloatUnderflow)) {}

LeafBall::LeafBall(const Point& at, const LeafBounds& bounds)
    : LeafBounds(bounds),
      centre(at),
      x(static_cast<float>(at.x)),
      y(static_cast<float>(at.y)),
      z(static_cast<float>(at.z)) {}

TreeBounds::TreeBounds(const Frame& frame, double radius)
    : outer(round_up((radius * (1 + kTreeError) + kTiny) * frame.scale)),
      inner(round_down((radius * (1 - kTreeError) - kTiny) * frame.scale)) {}

TreeBall::TreeBall(const FramePoint& at, const TreeBounds& bounds) : TreeBounds(bounds), x(at.x), y(at.y), z(at.z) {}

Isa best_isa() {
#if defined(MESHHOOD_HAS_X86)
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("bmi2") != 0) {
    return Isa::Avx512;
  }
  if (__builtin_cpu_supports("avx2") != 0) return Isa::Avx2;
#endif
  return Isa::Portable;
}

const Kernels& kernels(Isa isa) {
#if defined(MESHHOOD_HAS_X86)
  if (isa == Isa::Avx512) return avx512_kernels();
  if (isa == Isa::Avx2) return avx2_kernels();
#endif
  static_cast<void>(isa);
  return portable_kernels();
}

}  // namespace meshhood
