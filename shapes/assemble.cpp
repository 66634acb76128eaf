// SPDX-License-Identifier: MIT
#include "assemble.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace meshhood::shapes {

std::size_t root(double square, std::size_t least) { return std::max(least, nearest(std::sqrt(square))); }

std::size_t cube_root(std::size_t cube) {
  std::size_t side = 1;
  while (side * side * side < cube) ++side;
  return side;
}

void add_cell(Shape& shape, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  add_triangle(shape, a, b, d);
  if (c != d) add_triangle(shape, b, c, d);
}

Rings fit_rings(std::size_t count, double ideal_width) {
  const auto ideal = std::max<std::size_t>(3, nearest(ideal_width));
  const auto miss = [count](const Rings& r) {
    const std::size_t made = r.rings * r.width;
    return made > count ? made - count : count - made;
  };
  Rings best{std::max<std::size_t>(3, count / ideal), ideal};
  for (std::size_t width = std::max<std::size_t>(3, ideal / 2); width <= 2 * ideal; ++width) {
    const Rings rings{std::max<std::size_t>(3, (count + width / 2) / width), width};
    if (miss(rings) < miss(best)) best = rings;
  }
  return best;
}

}  // namespace meshhood::shapes
