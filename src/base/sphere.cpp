// SPDX-License-Identifier: MIT
// The smallest enclosing ball has at most four of the points on its boundary that determine it: its support.
// Repeatedly, the point farthest outside the ball of the present support is exchanged into it. This is the pivot rule
// of Gaertner, "Fast and robust smallest enclosing balls" (ESA 1999), with the basis computation of Matousek, Sharir
// and Welzl, "A subexponential bound for linear programming" (1996), done by trying all supports. The radius grows with
// every exchange, so no support comes back and the loop ends. If rounding spoils an exchange (points almost on one
// line, plane or sphere), the loop ends with the center it has: the radius is measured last, over all points, and is
// right for any center.
#include "base/sphere.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/vector.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr double kTolerance = 1e-3;
constexpr int kMaxExchanges = 64;

using Matrix = std::array<std::array<double, 3>, 3>;
using Vector = std::array<double, 3>;

struct Ball {
  Point center{};
  double squared_radius = 0;
};

/// Up to four points.
class Support {
 public:
  void add(const Point& p) {
    assert(size_ < points_.size());
    points_[size_++] = p;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Point& operator[](std::size_t i) const { return points_[i]; }

 private:
  std::array<Point, 4> points_{};
  std::size_t size_ = 0;
};

/// Solves the first `n` equations of `a x = b` by elimination with pivots, unless they are (nearly) dependent.
std::optional<Vector> solve(Matrix a, Vector b, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    }
    if (!(std::abs(a[pivot][k]) > 1e-14)) return std::nullopt;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  Vector x{};
  for (std::size_t k = n; k-- > 0;) {
    x[k] = b[k];
    for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
    x[k] /= a[k][k];
  }
  return x;
}

/// Returns the ball with all of `support` on its boundary and its center in their convex hull, if there is one. If the
/// center lies outside the hull, fewer of the points determine the smallest ball.
std::optional<Ball> circumscribed(const Support& support) {
  const std::size_t n = support.size() - 1;
  std::array<Point, 3> edge{};
  double scale = 0;
  for (std::size_t i = 0; i < n; ++i) {
    edge[i] = support[i + 1] - support[0];
    scale = std::max(scale, largest_component(edge[i]));
  }
  if (n > 0 && !(scale > 0)) return std::nullopt;
  // The unit is the largest component of an edge, so that no product overflows.
  for (std::size_t i = 0; i < n; ++i) edge[i] = {edge[i].x / scale, edge[i].y / scale, edge[i].z / scale};
  Matrix gram{};
  Vector half_square{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) gram[i][j] = dot(edge[i], edge[j]);
    half_square[i] = gram[i][i] / 2;
  }
  const std::optional<Vector> weight = solve(gram, half_square, n);
  if (!weight) return std::nullopt;
  Point offset{};
  double first_weight = 1;
  for (std::size_t i = 0; i < n; ++i) {
    if ((*weight)[i] < 0) return std::nullopt;
    first_weight -= (*weight)[i];
    offset = offset + (*weight)[i] * edge[i];
  }
  if (first_weight < 0) return std::nullopt;
  const Point center = support[0] + scale * offset;
  return Ball{center, squared_distance(center, support[0])};
}

/// Returns `p` and the points of `support` whose bits are set in `chosen`, at most three.
Support select(const Support& support, unsigned chosen, const Point& p) {
  Support result;
  result.add(p);
  for (std::size_t i = 0; i < support.size(); ++i) {
    if ((chosen >> i & 1U) != 0) result.add(support[i]);
  }
  return result;
}

bool encloses(const Ball& ball, const Support& support) {
  // Far from the origin, the rounding of the center counts: half a unit in the last place of each coordinate.
  const double rounding = 0x1p-50 * largest_component(ball.center) * std::sqrt(ball.squared_radius);
  for (std::size_t i = 0; i < support.size(); ++i) {
    if (!(squared_distance(ball.center, support[i]) <= ball.squared_radius * (1 + 1e-10) + rounding)) return false;
  }
  return true;
}

/// Returns the smallest ball around `support` and `p`, a point outside the present ball. The new ball has `p` on its
/// boundary, so its support is `p` with some of the old points. This tests each selection of them, and makes the right
/// one the support.
std::optional<Ball> exchange(Support& support, const Point& p) {
  for (unsigned chosen = 1; chosen < 1U << support.size(); ++chosen) {
    if (std::popcount(chosen) > 3) continue;
    const Support candidate = select(support, chosen, p);
    const std::optional<Ball> ball = circumscribed(candidate);
    if (!ball || !encloses(*ball, support)) continue;
    support = candidate;
    return ball;
  }
  return std::nullopt;
}

/// Returns the index of the point farthest from `from`, and its squared distance. `at(i)` is point `i`.
template <class At>
std::pair<std::size_t, double> farthest(std::size_t count, const At& at, const Point& from) {
  std::size_t index = 0;
  double largest = -1;
  for (std::size_t i = 0; i < count; ++i) {
    const double d2 = squared_distance(from, at(i));
    if (d2 > largest) {
      largest = d2;
      index = i;
    }
  }
  return {index, largest};
}

template <class At>
Point smallest_ball_center(std::size_t count, const At& at) {
  Support support;
  support.add(at(farthest(count, at, at(0)).first));
  Ball ball{support[0], 0};
  for (int exchanges = 0; exchanges < kMaxExchanges; ++exchanges) {
    const auto [index, d2] = farthest(count, at, ball.center);
    if (d2 <= ball.squared_radius * (1 + kTolerance) * (1 + kTolerance)) break;
    const std::optional<Ball> larger = exchange(support, at(index));
    if (!larger || larger->squared_radius <= ball.squared_radius) break;
    ball = *larger;
  }
  return ball.center;
}

template <class Real>
Real round_up(double value) {
  const auto rounded = static_cast<Real>(value);
  return static_cast<double>(rounded) < value ? std::nextafter(rounded, std::numeric_limits<Real>::infinity())
                                              : rounded;
}

}  // namespace

Point bounding_center(std::span<const Point> points) {
  return smallest_ball_center(points.size(), [&](std::size_t i) { return points[i]; });
}

template <class Real>
Sphere<Real> bounding_sphere(std::span<const Real> xyz) {
  const std::size_t count = xyz.size() / 3;
  const auto at = [&](std::size_t i) { return point(xyz, i); };
  const Point center = smallest_ball_center(count, at);
  Sphere<Real> sphere{static_cast<Real>(center.x), static_cast<Real>(center.y), static_cast<Real>(center.z), 0};
  sphere.radius = round_up<Real>(std::sqrt(farthest(count, at, center_of(sphere)).second));
  return sphere;
}

template Sphere<float> bounding_sphere(std::span<const float> xyz);
template Sphere<double> bounding_sphere(std::span<const double> xyz);

}  // namespace meshhood::inline v0_1
