// SPDX-License-Identifier: MIT
// Hardly surfaces at all: an edge is a polygon of two corners.
#include <cmath>
#include <cstddef>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {

// To and fro over a square, rows closer than the steps along them.
Shape path(std::size_t n) {
  constexpr double kGap = 0.75;
  const Sheet sheet{n, root(static_cast<double>(n), 2)};
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    const bool forwards = sheet.row(v) % 2 == 0;
    const std::size_t place = forwards ? sheet.place(v) : sheet.width - 1 - sheet.place(v);
    add_vertex(shape, {static_cast<double>(place), kGap * static_cast<double>(sheet.row(v)), 0});
  }
  for (std::size_t v = 1; v < n; ++v) add_polygon(shape, {v - 1, v});
  return shape;
}

Shape star(std::size_t n) {
  Shape shape;
  add_vertex(shape, {});
  for (std::size_t v = 1; v < n; ++v) {
    const Direction d = direction(static_cast<double>(v - 1) / static_cast<double>(n - 1));
    add_vertex(shape, {d.cos, d.sin, 0});
    add_polygon(shape, {0, v});
  }
  return shape;
}

Shape isolated(std::size_t n) {
  const Sheet sheet{n, root(static_cast<double>(n), 2)};
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    add_vertex(shape, {static_cast<double>(sheet.place(v)), static_cast<double>(sheet.row(v)), 0});
  }
  return shape;
}

}  // namespace meshhood::shapes
