// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "shared/distance.h"

namespace meshhood {

/// Eigenvalues and unit eigenvectors of the symmetric matrix [[p, o], [o, q]].
struct Eigen2 {
  double low;
  double high;
  std::array<double, 2> low_vector;
  std::array<double, 2> high_vector;
};
[[nodiscard]] Eigen2 eigen(double p, double o, double q);

/// A symmetric matrix of 3 by 3.
struct Symmetric3 {
  double xx;
  double xy;
  double xz;
  double yy;
  double yz;
  double zz;
};

/// Its eigenvalues, ascending, and a unit vector for each, orthogonal to the others. If an element is not finite, all
/// are NaN.
struct Eigen3 {
  std::array<double, 3> values;
  std::array<Point, 3> vectors;
};

/// By Jacobi's method: every eigenvalue is right to a few epsilon of the largest.
[[nodiscard]] Eigen3 eigen(const Symmetric3& matrix);

}  // namespace meshhood
