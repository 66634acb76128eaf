// SPDX-License-Identifier: MIT
// Surfaces without boundary, made of rings of vertices.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {
namespace {

/// Vertices `first .. first + size - 1`, evenly spaced around an axis, starting at angle 0. A single vertex is a pole.
struct Ring {
  std::size_t first;
  std::size_t size;

  [[nodiscard]] std::size_t steps() const { return size == 1 ? 0 : size; }
  [[nodiscard]] std::size_t operator[](std::size_t i) const { return first + i % size; }
};

/// Adds the band of triangles between two rings.
void add_band(Shape& shape, const Ring& upper, const Ring& lower) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < upper.steps() || j < lower.steps()) {
    const bool upper_next = i < upper.steps() && (i + 1) * lower.size <= (j + 1) * upper.size;
    if (upper_next || j == lower.steps()) {
      add_triangle(shape, upper[i], lower[j], upper[i + 1]);
      ++i;
    } else {
      add_triangle(shape, upper[i], lower[j], lower[j + 1]);
      ++j;
    }
  }
}

/// The radius of a sphere of `n` vertices whose triangles are about equilateral with edges of 1.
double sphere_radius(double vertices) { return std::sqrt(vertices * std::sqrt(0.75) / (4 * kPi)); }

/// The number of vertices of each ring, from pole to pole: proportional to its circumference, `n` in total.
std::vector<std::size_t> ring_sizes(std::size_t n, double radius) {
  const auto gaps = std::max<std::size_t>(2, static_cast<std::size_t>(kPi * radius / std::sqrt(0.75)));
  std::vector<double> up_to(gaps, 0);
  for (std::size_t k = 1; k < gaps; ++k) {
    up_to[k] = up_to[k - 1] + direction(0.5 * static_cast<double>(k) / static_cast<double>(gaps)).sin;
  }
  std::vector<std::size_t> sizes{1};
  std::size_t placed = 0;
  for (std::size_t k = 1; k < gaps; ++k) {
    const auto total = nearest(static_cast<double>(n - 2) * up_to[k] / up_to[gaps - 1]);
    sizes.push_back(total - placed);
    placed = total;
  }
  sizes.push_back(1);
  return sizes;
}

void add_sphere(Shape& shape, std::size_t n, const Point& center) {
  const double radius = sphere_radius(static_cast<double>(n));
  const auto sizes = ring_sizes(n, radius);
  Ring upper{shape.positions.size() / 3, 1};
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Ring ring{shape.positions.size() / 3, sizes[k]};
    const Direction polar = direction(0.5 * static_cast<double>(k) / static_cast<double>(sizes.size() - 1));
    for (std::size_t i = 0; i < ring.size; ++i) {
      const Direction around = direction(static_cast<double>(i) / static_cast<double>(ring.size));
      add_vertex(shape, center + radius * Point{polar.sin * around.cos, polar.sin * around.sin, polar.cos});
    }
    if (k > 0) add_band(shape, upper, ring);
    upper = ring;
  }
}

/// A point of the (2, 3) torus knot, which runs twice around the axis of a torus of radius 1 and three times around its
/// tube, and two directions perpendicular to the knot.
struct KnotPoint {
  Point center;
  Point outwards;
  Point sideways;
};

KnotPoint knot_point(double t) {
  constexpr double kTube = 0.45;
  const Direction major = direction(2 * t);
  const Direction minor = direction(3 * t);
  const Point radial{major.cos, major.sin, 0};
  const Point around{-major.sin, major.cos, 0};
  const Point up{0, 0, 1};
  const Point outwards = minor.cos * radial + minor.sin * up;
  const Point tangent = (2 * (1 + kTube * minor.cos)) * around + (3 * kTube) * (minor.cos * up - minor.sin * radial);
  return {radial + kTube * outwards, outwards, normalized(cross(tangent, outwards))};
}

}  // namespace

Shape sphere(std::size_t n) {
  Shape shape;
  add_sphere(shape, n, {});
  return shape;
}

// Spheres of about forty vertices in a cubic lattice, half an edge apart.
Shape soup(std::size_t n) {
  const std::size_t balls = std::max<std::size_t>(1, n / 40);
  const std::size_t side = cube_root(balls);
  const double pitch = 2 * sphere_radius(static_cast<double>(n) / static_cast<double>(balls)) + 0.5;
  const auto begin = [=](std::size_t ball) { return n / balls * ball + std::min(ball, n % balls); };
  Shape shape;
  for (std::size_t ball = 0; ball < balls; ++ball) {
    const std::size_t layer = ball / (side * side);
    const std::size_t column = ball / side % side;
    const Point cell{static_cast<double>(ball % side), static_cast<double>(column), static_cast<double>(layer)};
    add_sphere(shape, begin(ball + 1) - begin(ball), pitch * cell);
  }
  return shape;
}

Shape knot(std::size_t n) {
  constexpr double kThickness = 0.33;
  constexpr double kLength = 15.4;
  const double scale = std::sqrt(static_cast<double>(n) / (2 * kPi * kThickness * kLength));
  const auto [rings, width] = fit_rings(n, 2 * kPi * kThickness * scale);
  Shape shape;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const KnotPoint p = knot_point(static_cast<double>(ring) / static_cast<double>(rings));
    for (std::size_t i = 0; i < width; ++i) {
      const Direction d = direction(static_cast<double>(i) / static_cast<double>(width));
      add_vertex(shape, scale * (p.center + kThickness * (d.cos * p.outwards + d.sin * p.sideways)));
    }
  }
  for (std::size_t ring = 0; ring < rings; ++ring) {
    add_band(shape, {ring * width, width}, {(ring + 1) % rings * width, width});
  }
  return shape;
}

}  // namespace meshhood::shapes
