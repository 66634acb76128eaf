// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

/// Geometry from operations that IEEE 754 defines to the last bit. The sine and cosine of the C library are not used:
/// their last bit differs between platforms.
namespace meshhood::shapes {

struct Point {
  double x = 0;
  double y = 0;
  double z = 0;
};

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }

inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Point normalized(const Point& a) { return (1.0 / std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z)) * a; }

inline constexpr double kPi = std::numbers::pi;

/// A point of the unit circle.
struct Direction {
  double cos;
  double sin;
};

/// The direction at an angle given in turns. Accurate to about 1e-15.
[[nodiscard]] Direction direction(double turns);

}  // namespace meshhood::shapes
