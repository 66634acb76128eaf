// SPDX-License-Identifier: MIT
// Folded sheets: near in space, far along the surface.
#include <cmath>
#include <cstddef>
#include <vector>

#include "assemble.h"
#include "families.h"
#include "geometry.h"

namespace meshhood::shapes {
namespace {

/// A point of a spiral; consecutive points have a distance of about 1.
struct SpiralPoint {
  double radius;
  Direction direction;
};

/// An Archimedean spiral from `first_radius` outwards; its turns are `gap` apart.
std::vector<SpiralPoint> spiral(std::size_t count, double first_radius, double gap) {
  std::vector<SpiralPoint> points;
  points.reserve(count);
  double turns = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = first_radius + gap * turns;
    points.push_back({radius, direction(turns)});
    turns += 1.0 / std::sqrt(4 * kPi * kPi * radius * radius + gap * gap);
  }
  return points;
}

}  // namespace

Shape scroll(std::size_t n) {
  constexpr double kCore = 6;
  constexpr double kGap = 2.5;
  const Sheet sheet{n, root(static_cast<double>(n) / 9, 2)};
  const auto turns = spiral(sheet.rows(), kCore, kGap);
  return triangulated(sheet, [&](double row, double column) {
    const SpiralPoint& p = turns[static_cast<std::size_t>(row)];
    return Point{p.radius * p.direction.cos, p.radius * p.direction.sin, column};
  });
}

// A ribbon with a width of two vertices, so that almost all of it is far along the surface.
Shape strip(std::size_t n) {
  constexpr double kCore = 2;
  constexpr double kGap = 1.6;
  const Sheet sheet{n, 2};
  const auto turns = spiral(sheet.rows(), kCore, kGap);
  return triangulated(sheet, [&](double row, double column) {
    const SpiralPoint& p = turns[static_cast<std::size_t>(row)];
    const double radius = p.radius + 0.5 * kGap * column;
    return Point{radius * p.direction.cos, radius * p.direction.sin, 0};
  });
}

// An accordion: walls of `height` edges with gaps between them, connected alternately at the top and at the bottom.
Shape folds(std::size_t n) {
  constexpr double kGap = 1.5;
  const Sheet sheet{n, root(static_cast<double>(n) / 4, 2)};
  const auto height = static_cast<double>(root(static_cast<double>(sheet.rows()), 2));
  return triangulated(sheet, [=](double row, double column) {
    const double wall = std::floor(row / (height + 1));
    const double step = row - wall * (height + 1);
    const bool upwards = std::fmod(wall, 2) == 0;
    return Point{kGap * wall, column, upwards ? step : height - step};
  });
}

Shape plates(std::size_t n) {
  constexpr double kGap = 0.6;
  const Sheet sheet{n, root(static_cast<double>(n) / 2, 2)};
  const std::size_t half = (sheet.rows() + 1) / 2;
  const auto rows = static_cast<double>(half);
  return triangulated(sheet, [=](double row, double column) {
    return row < rows ? Point{row, column, 0} : Point{2 * rows - 1 - row, column, kGap};
  });
}

// A flat sheet with slits from all but its first rows.
Shape comb(std::size_t n) {
  constexpr double kGap = 0.5;
  constexpr std::size_t kTooth = 4;
  constexpr std::size_t kSpine = 3;
  const Sheet sheet{n, kTooth * root(static_cast<double>(n) / 64, 2)};
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    const auto column = static_cast<double>(sheet.column(v));
    const std::size_t tooth = sheet.column(v) / kTooth;
    add_vertex(shape, {column - (1 - kGap) * static_cast<double>(tooth), static_cast<double>(sheet.row(v)), 0});
  }
  sheet.for_each_cell([&](auto a, auto b, auto c, auto d) {
    const bool between_teeth = sheet.column(b) % kTooth == 0;
    if (!between_teeth || sheet.row(d) < kSpine) add_cell(shape, a, b, c, d);
  });
  return shape;
}

// Pages that share one spine, the first row. The other rows belong to the pages in turn.
Shape book(std::size_t n) {
  constexpr std::size_t kPages = 8;
  constexpr double kAngle = 0.01;
  const Sheet sheet{n, root(static_cast<double>(n) / kPages, 2)};
  Shape shape;
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t row = sheet.row(v);
    const std::size_t depth = (row + kPages - 1) / kPages;
    const Direction d = direction(kAngle * static_cast<double>(row % kPages));
    const auto radius = static_cast<double>(depth);
    add_vertex(shape, {radius * d.cos, radius * d.sin, static_cast<double>(sheet.column(v))});
  }
  sheet.for_each_cell([&](auto, auto, auto c, auto d) {
    const std::size_t a = d < (kPages + 1) * sheet.width ? sheet.column(d) : d - kPages * sheet.width;
    add_cell(shape, a, a + 1, c, d);
  });
  return shape;
}

}  // namespace meshhood::shapes
