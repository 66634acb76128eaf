// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "shared/distance.h"

namespace meshhood::inline v0_1 {

// Vector arithmetic. Every operation is rounded on its own, in the order written.

template <class Real>
[[nodiscard]] RealVector<Real> operator+(const RealVector<Real>& a, const RealVector<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
[[nodiscard]] RealVector<Real> operator-(const RealVector<Real>& a, const RealVector<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
[[nodiscard]] RealVector<Real> operator*(const std::type_identity_t<Real>& s, const RealVector<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class Real>
[[nodiscard]] Real dot(const RealVector<Real>& a, const RealVector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
[[nodiscard]] RealVector<Real> cross(const RealVector<Real>& a, const RealVector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[nodiscard]] inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

/// Returns the largest magnitude of a component.
[[nodiscard]] inline double largest_component(const Point& a) {
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// Returns the length also where squares underflow, as those of areas in the frame if a vertex is far from all others.
/// Elsewhere, it has the bits of `length`.
[[nodiscard]] inline double length_without_underflow(const Point& a) {
  if (const double size = length(a); size > 0x1p-480) return size;
  const double largest = largest_component(a);
  return largest > 0 ? largest * length({a.x / largest, a.y / largest, a.z / largest}) : 0;
}

/// Returns twice the vector area of a triangle: the same bits as those of the polygon below, without its loop.
[[nodiscard]] inline Point doubled_vector_area(const Point& a, const Point& b, const Point& c) {
  return Point{0, 0, 0} + cross(b - a, c - a);  // the sum has no -0, as for polygons
}

/// Returns twice the vector area of a polygon, about its first corner: the sum of the cross products of consecutive
/// corners (Newell). `corner(i)` is the position of corner `i`; 0 for fewer than three corners.
template <class F>
[[nodiscard]] Point doubled_vector_area(std::size_t corners, F&& corner) {
  Point sum{0, 0, 0};
  if (corners < 3) return sum;
  const Point first = corner(0);
  Point side = corner(1) - first;
  for (std::size_t i = 2; i < corners; ++i) {
    const Point next = corner(i) - first;
    sum = sum + cross(side, next);
    side = next;
  }
  return sum;
}

}  // namespace meshhood::inline v0_1
