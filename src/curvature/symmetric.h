// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "base/vector.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// A symmetric matrix of 3 by 3.
struct Symmetric3 {
  double xx;
  double xy;
  double xz;
  double yy;
  double yz;
  double zz;
};

/// The eigenvalues of a symmetric matrix, ascending, and a unit vector for each, orthogonal to the others. If an
/// element is not finite, all are NaN.
struct Eigen3 {
  std::array<double, 3> values;
  std::array<Point, 3> vectors;
};

/// The rotation of two axes by which Jacobi's method makes the element `pq` of a symmetric matrix 0, between the
/// elements `pp` and `qq` of its diagonal.
struct JacobiRotation {
  JacobiRotation(double pp, double qq, double pq) {
    const double ratio = (qq - pp) / (2 * pq);
    const double t = (ratio >= 0 ? 1 : -1) / (std::abs(ratio) + std::sqrt(1 + ratio * ratio));
    c = 1 / std::sqrt(1 + t * t);
    s = c * t;
  }

  void turn(double& x, double& y) const {
    const double before = x;
    x = c * before - s * y;
    y = s * before + c * y;
  }

  double c;
  double s;
};

/// Decomposes a matrix by Jacobi's method: every eigenvalue is right to a few epsilon of the largest.
[[nodiscard]] Eigen3 eigen(const Symmetric3& matrix);

/// A vector of length 0, which has no direction, stays as it is.
[[nodiscard]] inline Point unit(const Point& a) {
  const double size = length(a);
  return size == 0 ? a : (1 / size) * a;
}

/// Returns the vector, or its negative: the one whose component of largest magnitude is positive.
[[nodiscard]] inline Point with_sign(const Point& a) {
  const double largest = largest_component(a);
  const bool negative = a.x == -largest || (a.x != largest && (a.y == -largest || (a.y != largest && a.z < 0)));
  return negative ? -1 * a : a;
}

/// Writes row `row` of an array of 3 columns.
inline void set_row(std::span<double> rows, std::size_t row, const Point& p) {
  rows[3 * row] = p.x;
  rows[3 * row + 1] = p.y;
  rows[3 * row + 2] = p.z;
}

}  // namespace meshhood::inline v0_1
