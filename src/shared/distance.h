// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

#include "meshhood/export.h"
#include "meshhood/mesh.h"

// The predicate must round as it is written, on every machine.
#if defined(__FAST_MATH__)
#error "meshhood needs IEEE arithmetic: compile it without -ffast-math"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "meshhood needs arithmetic without excess precision: compile it with -msse2 -mfpmath=sse"
#endif

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Up to this, no square of a distance overflows.
inline constexpr double kLargestCoordinate = 0x1p500;

/// A vector of doubles, or of numbers of higher precision.
template <class Real>
struct RealVector {
  Real x;
  Real y;
  Real z;
};

using Point = RealVector<double>;

[[nodiscard]] inline bool is_valid_coordinate(double coordinate) { return std::abs(coordinate) <= kLargestCoordinate; }

/// Returns whether the coordinates are finite and at most 2^500 in magnitude.
[[nodiscard]] inline bool is_valid_position(const Point& p) {
  return is_valid_coordinate(p.x) && is_valid_coordinate(p.y) && is_valid_coordinate(p.z);
}

/// An axis-parallel box; empty at first.
struct BoundingBox {
  Point low{kInfinity, kInfinity, kInfinity};
  Point high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Point& p) { add(BoundingBox{p, p}); }
  void add(const BoundingBox& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y), std::min(low.z, box.low.z)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y), std::max(high.z, box.high.z)};
  }
};

template <class Real>
[[nodiscard]] Point point(const StridedPositions<Real>& xyz, std::size_t v) {
  return {static_cast<double>(xyz(v, 0)), static_cast<double>(xyz(v, 1)), static_cast<double>(xyz(v, 2))};
}

/// The type of these positions is known only at run time. Where many points are read, `visit` is faster.
[[nodiscard]] inline Point point(const PositionsView& positions, std::size_t v) {
  return positions.visit([v](const auto& xyz) { return point(xyz, v); });
}

template <class Real>
[[nodiscard]] Point point(std::span<const Real> xyz, std::size_t v) {
  return {static_cast<double>(xyz[3 * v]), static_cast<double>(xyz[3 * v + 1]), static_cast<double>(xyz[3 * v + 2])};
}

/// The library computes every distance with this function. Contraction is off for all its code, so every path rounds
/// alike.
[[nodiscard]] inline double squared_distance(const Point& p, const Point& q) {
  const double dx = p.x - q.x;
  const double dy = p.y - q.y;
  const double dz = p.z - q.z;
  return (dx * dx + dy * dy) + dz * dz;
}

/// Returns the largest double whose square root is at most `radius`: `sqrt(d2) <= radius` exactly if `d2 <=` this.
/// Testing against `radius * radius` would lose a vertex at the distance `radius` in about a quarter of the cases.
[[nodiscard]] double squared_radius(double radius);

/// Throws Error{InvalidRadius} unless `radius` is >= 0 or infinite. The message begins with `where`.
void check_radius(double radius, std::string_view where = {});

/// Throws Error{VertexOutOfRange} unless `v` < `vertices`, and as `check_radius`.
void check_query(VertexId v, std::size_t vertices, double radius, std::string_view where = {});

/// A sphere of an index, its center and radius rounded so that it still encloses what it was made for.
template <class Real>
struct Sphere {
  Real x;
  Real y;
  Real z;
  Real radius;
};

template <class Real>
[[nodiscard]] Point center_of(const Sphere<Real>& sphere) {
  return {static_cast<double>(sphere.x), static_cast<double>(sphere.y), static_cast<double>(sphere.z)};
}

enum class Containment { Outside, Intersecting, Inside };

/// Compares vertices with the closed ball around a query vertex: single vertices exactly, whole spheres conservatively.
class SearchBall {
 public:
  SearchBall(const Point& center, double radius)
      : center_(center),
        squared_radius_(meshhood::squared_radius(radius)),
        outer_radius_(radius * (1 + kSlack) + kTiny),
        inner_radius_((radius - kTiny) * (1 - kSlack)) {}

  [[nodiscard]] bool contains(const Point& p) const { return squared_distance(center_, p) <= squared_radius_; }

  [[nodiscard]] const Point& center() const { return center_; }

  /// `Outside` means that the ball contains no vertex in `sphere`, `Inside` that it contains every one, `Intersecting`
  /// that neither is certain.
  template <class Real>
  [[nodiscard]] Containment classify(const Sphere<Real>& sphere) const {
    const double distance2 = squared_distance(center_, center_of(sphere));
    const auto sphere_radius = static_cast<double>(sphere.radius);
    const double far = outer_radius_ + sphere_radius * (1 + kSlack);
    if (distance2 > far * far) return Containment::Outside;
    const double near = inner_radius_ - sphere_radius * (1 + kSlack);
    return near > 0 && distance2 < near * near ? Containment::Inside : Containment::Intersecting;
  }

 private:
  // The relative error of a computed distance is at most 4 * 2^-53, and the absolute error 2^-537 if squares underflow.
  // The bounds are relaxed by far more than the few such errors of one test, so that the classification of a sphere
  // never contradicts the predicate.
  static constexpr double kSlack = 1e-14;
  static constexpr double kTiny = 0x1p-500;

  Point center_;
  double squared_radius_;
  double outer_radius_;
  double inner_radius_;
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
