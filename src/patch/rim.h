// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "patch/angle.h"
#include "shared/distance.h"

namespace meshhood {

/// The arcs of the unit sphere along which a patch leaves it, which bound the part of the sphere behind the patch.
///
/// The potential of the area form that is singular at -k gives, for the arc from u to w about the unit vector n in the
/// plane at height h, of the angle theta,
///     theta (1 - h) - T(n, u, w) + T(k, u, w),
/// with T the signed area of a spherical triangle, T = 2 arg(1 + n.u + u.w + w.n + i n.(u x w)) (van Oosterom and
/// Strackee, "The solid angle of a plane triangle", 1983). The area to the right of all arcs is minus the sum, modulo
/// 4 pi. So the complex numbers are multiplied, and one arctangent is taken of the product. For h < 0, n is replaced by
/// -n: the arc is then -theta about it, and T is far from its singularity. An arc that is not short is divided, since
/// opposite ends have no spherical triangle.
class RimArcs {
 public:
  void clear();

  /// An arc counterclockwise about `n`, from `u` to `w`. O(1).
  void add(const Point& n, double h, double theta, const Point& u, const Point& w);

  /// A whole circle.
  void add_circle(double h);

  [[nodiscard]] bool empty() const { return count_ == 0; }

  /// The area behind, in [0, 4 pi). What is less than the error below 4 pi is 0: a sheet without thickness rather than
  /// a crack without width.
  [[nodiscard]] double area_behind() const;

 private:
  void add_part(const Point& n, const Point& u, const Point& w);

  std::vector<std::pair<Point, Point>> ends_;
  Complex product_{1, 0};
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace meshhood
