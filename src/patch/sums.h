// SPDX-License-Identifier: MIT
// The area and the volume of a patch are sums over its triangles and the arcs of its rim, where a ball cuts it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "shared/distance.h"
#include "simd/patches.h"

namespace meshhood::inline v0_1 {

/// A ball, and the unit of the frame.
struct PatchBall {
  Point center;
  double squared;  // of the predicate
  double scale;    // of the frame, a power of two
  double radius;   // in the frame; > 0, so that sides through the center of one that is next to nothing are found
  double unit;     // 1 / radius in the unit of the mesh; infinite if that is next to nothing

  [[nodiscard]] bool contains(const Point& p) const { return squared_distance(center, p) <= squared; }
};

[[nodiscard]] inline PatchBall patch_ball(const Point& center, double radius, double scale) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  return {center, squared_radius(radius), scale, std::max(kLeast, scale * radius), radius > 0 ? 1 / radius : kInfinity};
}

/// The circle in which a plane meets the unit sphere.
struct Circle {
  Point normal;     // a unit vector; 0 if the plane is that of a triangle without an area
  double distance;  // of the plane, along the normal

  [[nodiscard]] bool exists() const { return normal.x != 0 || normal.y != 0 || normal.z != 0; }
  [[nodiscard]] double radius() const { return std::sqrt((1 - distance) * (1 + distance)); }

  /// Returns the middle of the arc of the angle `theta` counterclockwise about the normal, from `u` to `w`.
  [[nodiscard]] Point middle(double theta, const Point& u, const Point& w) const;
};

/// Sums the arcs of the unit sphere along which a patch leaves it, which bound the part of the sphere behind the patch.
///
/// The potential of the area form that is singular at -k, the opposite of the pole k, gives, for the arc from u to w
/// about the unit vector n in the plane at height h, of the angle theta,
///     theta (1 - h) - T(n, u, w) + T(k, u, w),
/// with T the signed area of a spherical triangle, T = 2 arg(1 + n.u + u.w + w.n + i n.(u x w)) (van Oosterom and
/// Strackee, "The solid angle of a plane triangle", 1983). The area to the right of all arcs is minus the sum, modulo
/// 4 pi. So the complex numbers are multiplied, and one arctangent is taken of the product. For h < 0, n is replaced by
/// -n: the arc is then -theta about it, and T is far from its singularity. An arc that is not short is divided, since
/// opposite ends have no spherical triangle.
///
/// Near -k the last term is that of another pole l, whose triangles differ from it by those between the two poles:
///     T(k, u, w) = T(l, u, w) + T(k, u, l) - T(k, w, l), modulo 4 pi.
/// Where u is so near that its triangle has no certain area, the arc that ends there takes the same one away.
class RimArcs {
 public:
  /// Begins with a patch whose normal is about this one, of any length. Seen from there, the rim lies all around, most
  /// often far from the opposite point.
  void clear(const Point& normal);

  [[nodiscard]] const Point& pole() const { return pole_; }

  /// Adds an arc of the angle `theta` counterclockwise about the normal, from `u` to `w`. Takes O(1).
  void add(const Circle& circle, double theta, const Point& u, const Point& w);

  /// Adds an arc that `PatchKernels` have measured: what its angle adds, and its factor.
  void add_measured(double turn, const Complex& factor) {
    sum_ += turn;
    add_factor(factor);
  }

  /// Adds a whole circle.
  void add_circle(double h);

  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// Returns the area behind, in [0, 4 pi). Within the error of 4 pi, it is 0, since arcs do not tell these apart.
  [[nodiscard]] double area_behind() const;

 private:
  void add_factor(const Complex& factor) {
    const Complex product = times({real_, imaginary_}, factor);
    real_ = product.real();
    imaginary_ = product.imag();
    if (++count_ % 64 == 0) rescale();
  }

  void rescale();
  [[nodiscard]] Complex from_pole(const Point& u, const Point& w) const;

  Point pole_{0, 0, 1};
  Point other_{0, 1, 0};  // l, at a right angle
  double real_ = 1;       // of the product of all factors
  double sum_ = 0;        // stands between, since g++ 12 fuses the product of neighbors in spite of -ffp-contract=off
  double imaginary_ = 0;
  std::size_t count_ = 0;
};

/// Sums area and volume of the patch around the center of a ball from its parts.
///
/// The volume behind a patch is (sum of d A + r S) / 3, by the divergence theorem: d is the distance of a triangle's
/// plane from the center, along its normal, A the area of its part in the ball, S that of the part of the sphere
/// behind. The sum of d A over a meshlet is linear in the center.
class PatchSums {
 public:
  /// Begins with a patch whose normal is about this one, of any length.
  void clear(const Point& normal);

  /// Adds triangles in the ball: the sums of area and of area times distance, in the frame.
  void add_whole(double area, double moment) {
    area_ += area;
    moment_ += moment;
  }

  /// Adds the part in the ball of another triangle, in units of the radius. The caller adds its arcs to `rim`.
  void add_cut(double area, double distance) {
    cut_area_ += area;
    cut_moment_ += area * distance;
  }

  [[nodiscard]] RimArcs& rim() { return rim_; }

  void meet_border() { has_border_ = true; }

  /// Returns the area in the unit of the mesh.
  [[nodiscard]] double area(const PatchBall& ball) const;

  /// Returns NaN if a border is in the ball, else a volume that is not negative, in the frame: in the unit of the mesh,
  /// it may overflow. The patch must have a triangle.
  [[nodiscard]] double volume(const PatchBall& ball) const;

 private:
  RimArcs rim_;
  bool has_border_ = false;
  double area_ = 0;    // of whole triangles; these two in the frame
  double moment_ = 0;  // the sum of area times distance
  double cut_area_ = 0;
  double cut_moment_ = 0;
};

}  // namespace meshhood::inline v0_1
