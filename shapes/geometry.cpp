// SPDX-License-Identifier: MIT
#include "geometry.h"

#include <cmath>

namespace meshhood::shapes {
namespace {

/// The power series by Horner's rule, for |x| <= pi / 4; the first omitted term is below 1e-18.
Direction small_angle(double x) {
  const double square = x * x;
  double sin = 1.0;
  double cos = 1.0;
  for (int k = 9; k >= 1; --k) {
    sin = 1.0 - square / (2.0 * k * (2.0 * k + 1.0)) * sin;
    cos = 1.0 - square / (2.0 * k * (2.0 * k - 1.0)) * cos;
  }
  return {cos, x * sin};
}

}  // namespace

Direction direction(double turns) {
  const double quarters = std::floor(4.0 * turns + 0.5);
  const Direction d = small_angle(2.0 * kPi * (turns - 0.25 * quarters));
  switch (static_cast<int>(quarters - 4.0 * std::floor(0.25 * quarters))) {
    case 0: return d;
    case 1: return {-d.sin, d.cos};
    case 2: return {-d.cos, -d.sin};
    default: return {d.sin, -d.cos};
  }
}

}  // namespace meshhood::shapes
