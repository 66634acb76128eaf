// SPDX-License-Identifier: MIT
// Graphs: an edge is a polygon of two corners.
#include <cmath>
#include <cstddef>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {

// A path that runs back and forth over a square; its rows are closer than its steps.
Shape path(std::size_t n) {
  constexpr double kGap = 0.75;
  const Sheet sheet{n, root(static_cast<double>(n), 2)};
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    const bool forwards = sheet.row(v) % 2 == 0;
    const std::size_t column = forwards ? sheet.column(v) : sheet.width - 1 - sheet.column(v);
    add_vertex(shape, {static_cast<double>(column), kGap * static_cast<double>(sheet.row(v)), 0});
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
    add_vertex(shape, {static_cast<double>(sheet.column(v)), static_cast<double>(sheet.row(v)), 0});
  }
  return shape;
}

}  // namespace meshhood::shapes
