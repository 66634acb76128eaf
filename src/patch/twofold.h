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

/// A vector of doubles or of `Twofold`.
template <class Real>
struct RealVector {
  Real x;
  Real y;
  Real z;

  friend RealVector operator+(const RealVector& a, const RealVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend RealVector operator-(const RealVector& a, const RealVector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend RealVector operator*(const Real& s, const RealVector& a) { return {s * a.x, s * a.y, s * a.z}; }

  [[nodiscard]] Point round() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
};

template <class Real>
[[nodiscard]] Real dot(const RealVector<Real>& a, const RealVector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
[[nodiscard]] RealVector<Real> cross(const RealVector<Real>& a, const RealVector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
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
