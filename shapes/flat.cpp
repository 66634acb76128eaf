// SPDX-License-Identifier: MIT
// Sheets over a plane.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {
namespace {

Sheet square(std::size_t n) { return {n, root(static_cast<double>(n), 2)}; }

/// A pseudo-random number in [0, 1) (the finalizer of splitmix64).
double scatter(std::uint64_t key) {
  key = (key + 1) * 0x9e3779b97f4a7c15U;
  key = (key ^ (key >> 30U)) * 0xbf58476d1ce4e5b9U;
  key = (key ^ (key >> 27U)) * 0x94d049bb133111ebU;
  return static_cast<double>((key ^ (key >> 31U)) >> 11U) * 0x1p-53;
}

}  // namespace

Shape grid(std::size_t n) {
  return triangulated(square(n), [](double row, double column) { return Point{column, row, 0}; });
}

Shape quads(std::size_t n) {
  const Sheet sheet = square(n);
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    add_vertex(shape, {static_cast<double>(sheet.column(v)), static_cast<double>(sheet.row(v)), 0});
  }
  sheet.for_each_cell([&](auto a, auto b, auto c, auto d) {
    if (c == d) {
      add_polygon(shape, {a, b, d});
    } else {
      add_polygon(shape, {a, b, c, d});
    }
  });
  return shape;
}

Shape noise(std::size_t n) {
  constexpr double kHeight = 3;
  const Sheet sheet = square(n);
  return triangulated(sheet, [&](double row, double column) {
    const auto v = static_cast<std::uint64_t>(row) * sheet.width + static_cast<std::uint64_t>(column);
    return Point{column, row, kHeight * scatter(v)};
  });
}

// A honeycomb has the graph of a brick wall: rows of connected vertices, and every second vertex is connected to the
// row above. With an odd width and an even number of rows, every vertex is in a brick.
Shape ngons(std::size_t n) {
  const std::size_t width = 2 * root(static_cast<double>(n) / 4 - 1, 1) + 1;
  const std::size_t rows = 2 * ((n + width) / (2 * width));
  Shape shape;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const double tooth = (row + column) % 2 == 0 ? 0.25 : -0.25;
      add_vertex(shape, {std::sqrt(0.75) * static_cast<double>(column), 1.5 * static_cast<double>(row) + tooth, 0});
    }
  }
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = row % 2; column + 2 < width; column += 2) {
      const std::size_t a = row * width + column;
      const std::size_t d = a + width;
      add_polygon(shape, {a, a + 1, a + 2, d + 2, d + 1, d});
    }
  }
  return shape;
}

}  // namespace meshhood::shapes
