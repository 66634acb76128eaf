// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace meshhood::inline v0_1 {

using Complex = std::complex<double>;

/// A product, without the functions of the standard library for infinite factors.
[[nodiscard]] inline Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Of the rational function of the library Cephes for the arctangent (S. L. Moshier), from the highest power on; the
/// first coefficient of the one below is 1.
inline constexpr std::array kArctangentAbove{-8.750608600031904122785e-1, -1.615753718753365076637e1,
                                             -7.500855792314704667340e1, -1.228866684490136173410e2,
                                             -6.485021904942025371773e1};
inline constexpr std::array kArctangentBelow{2.485846490142306297962e1, 1.650270098316988542046e2,
                                             4.328810604912902668951e2, 4.853903996359136964868e2,
                                             1.945506571482613964425e2};

/// The arctangent of t, |t| < 0.67.
[[nodiscard]] inline double small_arctangent(double t) {
  const double z = t * t;
  double above = 0;
  for (const double coefficient : kArctangentAbove) above = above * z + coefficient;
  double below = 1;
  for (const double coefficient : kArctangentBelow) below = below * z + coefficient;
  return t + t * (z * above / below);
}

/// The argument in [-pi, pi], 0 of 0. The function of the standard library rounds differently on some processors.
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

}  // namespace meshhood::inline v0_1
