// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "geometry.h"
#include "shapes.h"

/// How shapes are put together, vertex by vertex and face by face.
namespace meshhood::shapes {

inline void add_vertex(Shape& shape, const Point& p) {
  for (const double coordinate : {p.x, p.y, p.z}) shape.positions.push_back(static_cast<float>(coordinate));
}

inline void add_triangle(Shape& shape, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t corner : {a, b, c}) shape.corners.push_back(static_cast<std::uint32_t>(corner));
}

/// Not to be mixed with `add_triangle` in one shape.
inline void add_polygon(Shape& shape, std::initializer_list<std::size_t> corners) {
  if (shape.offsets.empty()) shape.offsets.push_back(0);
  for (const std::size_t corner : corners) shape.corners.push_back(static_cast<std::uint32_t>(corner));
  shape.offsets.push_back(shape.corners.size());
}

[[nodiscard]] inline std::size_t nearest(double value) { return static_cast<std::size_t>(std::lround(value)); }

/// The whole number nearest to the square root, and at least `least`.
[[nodiscard]] std::size_t root(double square, std::size_t least);

/// The least whole number, at least 1, whose cube is no less than `cube`.
[[nodiscard]] std::size_t cube_root(std::size_t cube);

/// Vertices `0 .. count - 1` laid out row after row, `width >= 2` in a row, the last row perhaps cut short. A cell lies
/// between four of them.
struct Sheet {
  std::size_t count;
  std::size_t width;

  [[nodiscard]] std::size_t rows() const { return (count + width - 1) / width; }
  [[nodiscard]] std::size_t row(std::size_t vertex) const { return vertex / width; }
  [[nodiscard]] std::size_t place(std::size_t vertex) const { return vertex % width; }

  /// Calls `f(a, b, c, d)` for every cell, its corners in a ring, `a` in the lower row and first in it. A cell that the
  /// cut row leaves with three corners, which keeps every vertex in a face, has `c == d`.
  template <class F>
  void for_each_cell(F&& f) const {
    for (std::size_t d = width; d < count; ++d) {
      const bool last = place(d) + 1 == width;
      if (!last) f(d - width, d - width + 1, d + 1 < count ? d + 1 : d, d);
    }
  }
};

/// A cell of a sheet as one or two triangles.
void add_cell(Shape& shape, std::size_t a, std::size_t b, std::size_t c, std::size_t d);

/// A sheet of triangles whose vertex `v` lies at `point(row, place)`.
template <class F>
Shape triangulated(const Sheet& sheet, F&& point) {
  Shape shape;
  for (std::size_t v = 0; v < sheet.count; ++v) {
    add_vertex(shape, point(static_cast<double>(sheet.row(v)), static_cast<double>(sheet.place(v))));
  }
  sheet.for_each_cell([&](auto a, auto b, auto c, auto d) { add_cell(shape, a, b, c, d); });
  return shape;
}

/// As many rings of as many vertices, both within bounds, as come nearest to `count`.
struct Rings {
  std::size_t rings;
  std::size_t width;
};

/// `width` between half and twice `ideal_width`, no smaller than 3, and taken from its neighbours where that hits
/// `count` better. At least three rings.
[[nodiscard]] Rings fit_rings(std::size_t count, double ideal_width);

}  // namespace meshhood::shapes
