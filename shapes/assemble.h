// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "geometry.h"
#include "shapes.h"

/// Assembling shapes from vertices and faces.
namespace meshhood::shapes {

inline void add_vertex(Shape& shape, const Point& p) {
  for (const double coordinate : {p.x, p.y, p.z}) shape.positions.push_back(static_cast<float>(coordinate));
}

inline void add_triangle(Shape& shape, std::size_t a, std::size_t b, std::size_t c) {
  for (const std::size_t corner : {a, b, c}) shape.corners.push_back(static_cast<std::uint32_t>(corner));
}

/// Do not mix with `add_triangle` in one shape.
inline void add_polygon(Shape& shape, std::initializer_list<std::size_t> corners) {
  if (shape.offsets.empty()) shape.offsets.push_back(0);
  for (const std::size_t corner : corners) shape.corners.push_back(static_cast<std::uint32_t>(corner));
  shape.offsets.push_back(shape.corners.size());
}

[[nodiscard]] inline std::size_t nearest(double value) { return static_cast<std::size_t>(std::lround(value)); }

/// The square root, rounded to an integer, at least `least`.
[[nodiscard]] std::size_t root(double square, std::size_t least);

/// The smallest integer >= 1 whose cube is at least `cube`.
[[nodiscard]] std::size_t cube_root(std::size_t cube);

/// Vertices `0 .. count - 1` in rows of `width >= 2`; the last row may be shorter. A cell has four of them as corners.
struct Sheet {
  std::size_t count;
  std::size_t width;

  [[nodiscard]] std::size_t rows() const { return (count + width - 1) / width; }
  [[nodiscard]] std::size_t row(std::size_t vertex) const { return vertex / width; }
  [[nodiscard]] std::size_t column(std::size_t vertex) const { return vertex % width; }

  /// Calls `f(a, b, c, d)` for every cell, with its corners in cyclic order; `a` is the first corner of the lower row.
  /// A cell that has only three corners because the last row is short has `c == d`, so that every vertex is in a face.
  template <class F>
  void for_each_cell(F&& f) const {
    for (std::size_t d = width; d < count; ++d) {
      const bool last = column(d) + 1 == width;
      if (!last) f(d - width, d - width + 1, d + 1 < count ? d + 1 : d, d);
    }
  }
};

/// Adds a cell of a sheet as one or two triangles.
void add_cell(Shape& shape, std::size_t a, std::size_t b, std::size_t c, std::size_t d);

/// Adds a sheet of triangles; `point(row, column)` is the position of a vertex.
template <class F>
Shape triangulated(const Sheet& sheet, F&& point) {
  Shape shape;
  for (std::size_t v = 0; v < sheet.count; ++v) {
    add_vertex(shape, point(static_cast<double>(sheet.row(v)), static_cast<double>(sheet.column(v))));
  }
  sheet.for_each_cell([&](auto a, auto b, auto c, auto d) { add_cell(shape, a, b, c, d); });
  return shape;
}

/// The number of rings and of vertices per ring, within bounds, whose product is nearest to `count`.
struct Rings {
  std::size_t rings;
  std::size_t width;
};

/// The width is between half and twice `ideal_width` and at least 3, chosen so that the product is nearest to `count`.
/// There are at least three rings.
[[nodiscard]] Rings fit_rings(std::size_t count, double ideal_width);

}  // namespace meshhood::shapes
