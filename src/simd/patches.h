// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>

#include "simd/kernels.h"
#include "simd/leaf.h"

/// The inner loops of areas, volumes and gaps measure triangles in balls. As in `Kernels`, each function gives the same
/// result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

using Complex = std::complex<double>;

/// Multiplies without the functions of the standard library for infinite factors.
[[nodiscard]] inline Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// These are the coefficients, from the highest power on, of the rational function of the library Cephes for the
/// arctangent (S. L. Moshier); the first of the denominator, 1, is left out.
inline constexpr std::array kArctangentAbove{-8.750608600031904122785e-1, -1.615753718753365076637e1,
                                             -7.500855792314704667340e1, -1.228866684490136173410e2,
                                             -6.485021904942025371773e1};
inline constexpr std::array kArctangentBelow{2.485846490142306297962e1, 1.650270098316988542046e2,
                                             4.328810604912902668951e2, 4.853903996359136964868e2,
                                             1.945506571482613964425e2};

/// Returns the arctangent of t, |t| < 0.67.
[[nodiscard]] inline double small_arctangent(double t) {
  const double z = t * t;
  double above = 0;
  for (const double coefficient : kArctangentAbove) above = above * z + coefficient;
  double below = 1;
  for (const double coefficient : kArctangentBelow) below = below * z + coefficient;
  return t + t * (z * above / below);
}

/// Returns the argument in [-pi, pi], 0 for 0. `std::atan2` rounds differently on some processors.
[[nodiscard]] inline double argument(const Complex& number) {
  constexpr double kPi = std::numbers::pi;
  const double x = std::abs(number.real());
  const double y = std::abs(number.imag());
  const double low = std::min(x, y);
  const double high = std::max(x, y);
  if (high == 0) return 0;
  const bool is_steep = low > 0.66 * high;
  const double eighth =
      is_steep ? kPi / 4 + small_arctangent((low - high) / (low + high)) : small_arctangent(low / high);
  const double quarter = y > x ? kPi / 2 - eighth : eighth;
  return std::copysign(number.real() < 0 ? kPi - quarter : quarter, number.imag());
}

/// A corner farther away than so many radii is far. In double, the nearest point of a line is off by a few 2^-53 of its
/// corners' distance: about 2^-47 of the radius or less, unless a corner is far.
inline constexpr double kFar = 64;

/// The nearest point of a side that touches the ball decides whether the side dips into it. This point is not computed
/// for a side that misses the ball by more than this share.
inline constexpr double kTouchSlack = 1e-9;

/// The sign of the imaginary part of the turn of an arc is clear, unless that part is so small beside the real one.
inline constexpr double kClearTurn = 1e-6;

/// A triangle with a side whose square is so small beside that of another is a needle: the normal follows from the
/// short side, since the others differ by little more than their rounding.
inline constexpr double kNeedle = 0x1p-20;

/// An arc of at least this angle has nearly opposite ends, or more than that, and is added in four parts.
inline constexpr double kLongArc = 2;

/// An arc is near the opposite of the pole of its rim if the squared size of its factor from the pole is smaller. The
/// argument of the factor is uncertain there.
inline constexpr double kClearPole = 0x1p-12;

/// Four numbers of a lane. Kernels read such rows where they lie, and turn those of several lanes into vectors.
using LaneRow = std::array<double, 4>;

[[nodiscard]] inline LaneRow lane_row(const Point& p, double fourth = 0) { return {p.x, p.y, p.z, fourth}; }

/// A triangle and a ball for each lane. One corner, the first, is alone inside or outside.
struct CutTriangles {
  std::array<const LaneRow*, kPacketCapacity> corners;  // three, from the first on, in the orientation of the triangle
  std::array<const LaneRow*, kPacketCapacity> balls;    // the center and 1 / radius; the pole of the rim, a unit vector
  PerLane<double> insides;                              // 1 if the first corner is in the ball, else -1
};

/// Holds what `ClippedTriangle::measure` finds of each triangle, and adds to the rim: one arc.
struct ClippedTriangles {
  PerLane<double> area;
  PerLane<double> distance;
  PerLane<double> turn;  // what the angle of the arc adds to the area behind
  PerLane<double> real;  // of the factor of the arc: see `RimArcs`
  PerLane<double> imaginary;
};

/// Sums over triangles in the balls of some queries: of area, vector area, and area times distance of the plane from
/// `point`, along the normal. From a point far from the triangles, the last would lose digits.
struct WholeTriangles {
  double area;
  Point vector;
  double moment;
  Point point;
  QueryWord queries;
};

/// Sums of each query over triangles in its ball.
struct WholeSums {
  PerLane<double> area;
  PerLane<double> moment;  // area times the distance of the plane
};

struct PatchKernels {
  /// Adds triangles to the sums of their queries: their area, and their moment from the center of the query.
  void (*add_whole)(std::span<const WholeTriangles> triangles, const PointPerLane<double>& centers, double scale,
                    WholeSums& sums);

  /// Measures the first `count` triangles; reads and writes whole vectors, so the lanes behind them need rows, too.
  /// Returns those that it has measured: not one that has no area, is a needle, has a corner far away, an arc that is
  /// not short or near the opposite of the pole, or a third side that may dip into the ball.
  LaneMask (*measure)(const CutTriangles& cut, std::size_t count, ClippedTriangles& clipped);

  /// Returns which of them have one corner in the ball, and a third side that may dip into it or a corner far away.
  LaneMask (*may_dip)(const CutTriangles& cut, std::size_t count);

  /// Returns those of `queries` that may have a point of a triangle within their reach. The others have none, but for
  /// rounding. The fourth power of a reach must not underflow.
  QueryWord (*may_reach)(const std::array<Point, 3>& corners, QueryWord queries, const PointPerLane<double>& centers,
                         const PerLane<double>& squared_reaches);
};

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const PatchKernels& patch_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
