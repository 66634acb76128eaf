// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vector.h"
#include "patch/sums.h"
#include "patch/twofold.h"
#include "shared/distance.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {

/// Returns the number of the corner or side of a triangle after `i`.
[[nodiscard]] constexpr std::size_t after(std::size_t i) { return i == 2 ? 0 : i + 1; }

/// The corners of a triangle in the unit of the mesh, and what is known of them.
struct PatchTriangle {
  std::array<Point, 3> corners;
  std::array<std::uint32_t, 3> places;
  std::array<bool, 3> inside;
};

/// Finds the part of a triangle in a ball that does not contain all of its corners. Lengths are in units of the radius,
/// from the center of the ball.
///
/// Its boundary runs along chords, the parts of the sides in the ball, and along arcs from where a side leaves the ball
/// to where the next one enters it. All of it follows from the point of each side's line that is nearest to the center.
/// Where a corner is far away beside the radius, this point is computed in twice the precision. Triangles that share a
/// side have the same point, bit for bit.
class ClippedTriangle {
 public:
  ClippedTriangle(const PatchBall& ball, const PatchTriangle& triangle);

  /// Return whether side `i`, from corner `i`, meets the ball, and whether it does although no corner is in it.
  [[nodiscard]] bool meets(std::size_t i) const { return sides_[i].is_cut; }
  [[nodiscard]] bool dips(std::size_t i) const { return sides_[i].dips; }

  struct Measure {
    double area;
    double distance;  // of the plane, along the normal
  };

  /// Measures the part in the ball, and adds its arcs to `rim`.
  [[nodiscard]] Measure measure(RimArcs& rim);
  void add_to(PatchSums& sums);

  /// Finds what the functions below return.
  void find_outline();

  [[nodiscard]] bool is_cut() const { return sides_[0].is_cut || sides_[1].is_cut || sides_[2].is_cut; }
  /// Returns whether no side is cut, and the disc in which the plane meets the ball lies in the triangle.
  [[nodiscard]] bool has_disc() const { return !is_cut() && plane_.has_foot && std::abs(plane_.circle.distance) < 1; }
  /// Without an area, the normal is 0.
  [[nodiscard]] const Circle& circle() const { return plane_.circle; }

  /// Return where side `i` enters the ball, and where it leaves it, unless a corner is inside.
  [[nodiscard]] Point entry(std::size_t i) const { return sides_[i].nearest - sides_[i].half * sides_[i].along; }
  [[nodiscard]] Point exit(std::size_t i) const { return sides_[i].nearest + sides_[i].half * sides_[i].along; }
  /// Returns whether no point of side `i` in the ball is away from the sphere, but for rounding.
  [[nodiscard]] bool touches(std::size_t i) const;

  /// Returns whether the boundary leaves side `i` where this leaves the ball.
  [[nodiscard]] bool has_arc(std::size_t i) const { return meets(i) && !triangle_->inside[(i + 1) % 3]; }

  struct Arc {
    std::size_t to;  // the side that it leads to
    double angle;
  };

  [[nodiscard]] Arc arc_from(std::size_t i) const;

 private:
  /// `nearest`, `along` and `is_between` are set where the side is cut or may dip; the other numbers by `find_outline`,
  /// where it is cut.
  struct Side {
    Point nearest;  // of its line
    Point along;    // a unit vector; 0 if the corners are at the same place
    double half;    // of the chord of the line
    double from;    // its part in the ball, from `nearest` on
    double to;
    double offset;    // of the line, from the foot of the center on the plane, to the right
    bool is_between;  // whether `nearest` lies between the ends
    bool is_cut = false;
    bool dips = false;
  };

  struct Plane {
    Circle circle{{0, 0, 0}, 0};
    bool has_foot = false;  // of the perpendicular from the center, within the triangle
  };

  template <class Real>
  static void set_line(Side& side, const RealVector<Real>& begin, const RealVector<Real>& whole, double unit,
                       double sign);
  void find_nearest(std::size_t i);
  void find_chord(std::size_t i);
  template <class Real>
  [[nodiscard]] Plane find_plane() const;
  [[nodiscard]] bool may_dip(std::size_t i) const;
  [[nodiscard]] Point vector_area() const;
  [[nodiscard]] Complex turn_at(std::size_t corner) const;
  [[nodiscard]] double angle_of_arc(std::size_t from, std::size_t steps) const;
  [[nodiscard]] double distance_of_plane() const;

  const PatchBall* ball_;
  const PatchTriangle* triangle_;
  std::array<Point, 3> corners_;  // from the center
  std::array<Side, 3> sides_;
  bool is_far_ = false;
  Plane plane_;
};

}  // namespace meshhood::inline v0_1
