// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "simd/kernels.h"
#include "simd/leaf.h"

/// Triangles in balls: the inner loops of areas, volumes and gaps. As in `Kernels`, each function gives the same
/// result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

/// A corner farther away than so many radii is far. In double, the nearest point of a line is off by a few 2^-53 of its
/// corners' distance: below 1e-13 of the radius, unless a corner is far.
inline constexpr double kFar = 64;

/// Whether a side that touches the ball dips into it is decided by its nearest point; of one that misses the ball by
/// more than this share, none is computed.
inline constexpr double kTouchSlack = 1e-9;

/// The sign of the imaginary part of the turn of an arc is clear, unless that part is so small beside the real one.
inline constexpr double kClearTurn = 1e-6;

/// A triangle with a side whose square is so small beside that of another is a needle: the normal follows from the
/// short side, since the others differ by little more than their rounding.
inline constexpr double kNeedle = 0x1p-20;

/// An arc of at least this angle has nearly opposite ends, or more than that, and is added in four parts.
inline constexpr double kLongArc = 2;

/// Triangles that a sphere cuts, each with its ball. One corner, the first, is alone inside or outside.
struct CutTriangles {
  std::array<PointPerLane<double>, 3> corners;  // in the orientation of the triangle
  PointPerLane<double> centers;
  PointPerLane<double> poles;  // of the rims: unit vectors
  PerLane<double> units;       // 1 / radius
  PerLane<double> insides;     // 1 if the first corner is in the ball, else -1
  /// By side, from the corner of its number on: 1, or -1 if its line is computed from the other end, as in the other
  /// triangle that has the side.
  std::array<PerLane<double>, 3> directions;
};

/// What `ClippedTriangle::measure` finds of each, and adds to the rim: an arc from `from` to `to`.
struct ClippedTriangles {
  PerLane<double> area;
  PerLane<double> distance;
  PerLane<double> turn;  // what the angle of the arc adds to the area behind
  PerLane<double> real;  // of the arc's factor, and of the one of the pole: see `RimArcs`
  PerLane<double> imaginary;
  PerLane<double> real_from_pole;
  PerLane<double> imaginary_from_pole;
  PointPerLane<double> from;
  PointPerLane<double> to;
};

/// Triangles in balls: sums of area, vector area, and area times distance of the plane from a point.
struct WholeTriangles {
  double area;
  Point vector;
  Point point;
  double moment;
};

/// Sums of each query over triangles in its ball.
struct WholeSums {
  PerLane<double> area;
  PerLane<double> moment;  // area times the distance of the plane
};

struct PatchKernels {
  /// Adds triangles to the sums of the queries of a word: their area, and their moment from the center of the query,
  /// where `moment` is that from `point`.
  void (*add_whole)(const WholeTriangles& triangles, QueryWord queries, const PointPerLane<double>& centers,
                    double scale, WholeSums& sums);

  /// Measures the first `count` triangles; reads and writes whole vectors. Returns those that it has measured: not one
  /// with a corner far away, without an area, a needle, with an arc that is not short, or whose third side may dip into
  /// the ball.
  LaneMask (*measure)(const CutTriangles& cut, std::size_t count, ClippedTriangles& clipped);

  /// Which of them have one corner in the ball, and a third side that may dip into it or a corner far away.
  LaneMask (*may_dip)(const CutTriangles& cut, std::size_t count);

  /// Those of `queries` that may have a point of a triangle within their reach. The others have none, but for rounding.
  /// Fourth powers of a reach must not vanish.
  QueryWord (*may_reach)(const std::array<Point, 3>& corners, QueryWord queries, const PointPerLane<double>& centers,
                         const PerLane<double>& squared_reaches);
};

/// Those compiled for `isa`, which this processor must have.
[[nodiscard]] const PatchKernels& patch_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
