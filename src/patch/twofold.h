// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <utility>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

/// A number of about 106 bits, the sum of two doubles that do not overlap (T. J. Dekker, "A floating-point technique
/// for extending the available precision", Numerische Mathematik 18, 1971). It serves corners so far from a ball that
/// what cancels in double would matter there.
struct Twofold {
  double high;
  double low = 0;

  Twofold(double value) : high(value) {}
  Twofold(double first, double second) : high(first + second), low(second - (high - first)) {}  // |first| >= |second|

  /// Adds without an error.
  [[nodiscard]] static Twofold sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
  }

  /// Multiplies without an error, unless a factor is beyond 2^995. It uses no fused operation; the library never does.
  [[nodiscard]] static Twofold product(double a, double b) {
    const auto [a_high, a_low] = halves(a);
    const auto [b_high, b_low] = halves(b);
    const double product = a * b;
    return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
  }

  friend Twofold operator+(const Twofold& a, const Twofold& b) {
    const Twofold s = sum(a.high, b.high);
    return {s.high, s.low + (a.low + b.low)};
  }
  friend Twofold operator-(const Twofold& a, const Twofold& b) { return a + Twofold{-b.high, -b.low}; }
  friend Twofold operator*(const Twofold& a, const Twofold& b) {
    const Twofold p = product(a.high, b.high);
    return {p.high, p.low + (a.high * b.low + a.low * b.high)};
  }
  friend Twofold operator/(const Twofold& a, const Twofold& b) {
    const Twofold quotient = a.high / b.high;
    return quotient + Twofold((a - quotient * b).high / b.high);
  }
  explicit operator double() const { return high; }

 private:
  /// Returns the upper and the lower 26 bits of a number.
  static std::pair<double, double> halves(double a) {
    const double shifted = 0x1.0000002p27 * a;
    const double upper = shifted - (shifted - a);
    return {upper, a - upper};
  }
};

/// Rounds a vector to double.
template <class Real>
[[nodiscard]] Point in_double(const RealVector<Real>& a) {
  return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
}

/// Returns `p` - `center`, times `scale`, a power of two, which does not round.
template <class Real>
[[nodiscard]] RealVector<Real> offset_of(const Point& p, const Point& center, double scale) {
  const auto axis = [&](double x, double from) -> Real {
    if constexpr (std::is_same_v<Real, double>) {
      return scale * (x - from);
    } else {
      return Twofold::sum(scale * x, -scale * from);
    }
  };
  return {axis(p.x, center.x), axis(p.y, center.y), axis(p.z, center.z)};
}

}  // namespace meshhood::inline v0_1
