// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/families.h"

namespace meshhood::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t side(std::size_t vertices) {
  return std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(vertices)))));
}

/// Vertices at `surface(u, v)` for u, v in [0, 1), or [0, 1] where the grid is open.
template <class Surface>
TestMesh patch(const GridFaces& grid, Surface&& surface) {
  TestMesh mesh;
  const auto rows = static_cast<double>(grid.closed_columns ? grid.rows : grid.rows - 1);
  const auto regions = static_cast<double>(grid.closed_rows ? grid.regions : grid.regions - 1);
  for (std::size_t r = 0; r < grid.rows; ++r) {
    for (std::size_t c = 0; c < grid.regions; ++c) {
      const std::array<double, 3> p = surface(static_cast<double>(c) / regions, static_cast<double>(r) / rows);
      mesh.add_vertex(p[0], p[1], p[2]);
    }
  }
  add_grid_faces(mesh, grid);
  return mesh;
}

TestMesh triangle_grid(Random&, std::size_t vertices) { return make_grid(side(vertices), side(vertices), false); }
TestMesh quad_grid(Random&, std::size_t vertices) { return make_grid(side(vertices), side(vertices), true); }

TestMesh noisy_grid(Random& random, std::size_t vertices) {
  TestMesh mesh = make_grid(side(vertices), side(vertices), random.below(2) == 0);
  for (double& x : mesh.positions) x += random.uniform(-0.8, 0.8);
  return mesh;
}

TestMesh sphere(Random& random, std::size_t vertices) {
  const std::size_t n = std::max<std::size_t>(3, side(vertices));
  const double radius = random.uniform(0.1, 100);
  return patch({.rows = n, .regions = n, .closed_rows = true}, [&](double u, double v) {
    const double ring = radius * std::sin(std::numbers::pi * v);
    return std::array{ring * std::cos(kTurn * u), ring * std::sin(kTurn * u), radius * std::cos(std::numbers::pi * v)};
  });
}

TestMesh torus(Random& random, std::size_t vertices) {
  const std::size_t n = std::max<std::size_t>(3, side(vertices));
  const double thickness = random.uniform(0.05, 0.95);
  const GridFaces grid{
      .rows = n, .regions = n, .closed_rows = true, .closed_columns = true, .quads = random.below(2) == 0};
  return patch(grid, [&](double u, double v) {
    const double ring = 1 + thickness * std::cos(kTurn * v);
    return std::array{ring * std::cos(kTurn * u), ring * std::sin(kTurn * u), thickness * std::sin(kTurn * v)};
  });
}

/// A band with half a twist: the last region meets the first upside down.
TestMesh moebius(Random&, std::size_t vertices) {
  const std::size_t regions = std::max<std::size_t>(4, vertices / 3);
  const GridFaces grid{.rows = 3, .regions = regions};
  TestMesh mesh = patch(grid, [&](double u, double v) {
    const double angle = kTurn * u * static_cast<double>(regions - 1) / static_cast<double>(regions);
    const double width = (v - 0.5) * 0.4;
    const double ring = 1 + width * std::cos(angle / 2);
    return std::array{ring * std::cos(angle), ring * std::sin(angle), width * std::sin(angle / 2)};
  });
  const auto n = static_cast<std::uint32_t>(regions);
  for (std::uint32_t r = 0; r < 2; ++r) {
    mesh.add_face({r * n + n - 1, (r + 1) * n + n - 1, (1 - r) * n, (2 - r) * n});
  }
  return mesh;
}

/// One sheet in narrow folds: most of what is near in space is far along the sheet.
TestMesh pleated_sheet(Random& random, std::size_t vertices) {
  const std::size_t n = side(vertices);
  const double narrow = random.uniform(0.01, 0.3);
  const GridFaces grid{.rows = n, .regions = n};
  return patch(grid, [&](double u, double v) {
    const double along = u * static_cast<double>(n - 1);
    const double fold = std::floor(along / 4);
    const double within = along / 4 - fold;
    const bool back = std::fmod(fold, 2.0) != 0;
    return std::array{narrow * (fold + within), (back ? 1 - within : within) * 4, v * static_cast<double>(n - 1)};
  });
}

/// Unconnected sheets on top of each other, some at distance zero.
TestMesh touching_sheets(Random& random, std::size_t vertices) {
  TestMesh mesh;
  const std::size_t sheets = 2 + random.below(4);
  const std::size_t n = side(std::max<std::size_t>(4, vertices / sheets));
  double height = 0;
  for (std::size_t s = 0; s < sheets; ++s) {
    TestMesh sheet = make_grid(n, n, s % 2 == 0);
    for (std::size_t v = 0; v < sheet.size(); ++v) sheet.positions[3 * v + 2] = height;
    append(mesh, sheet);
    height += random.below(2) == 0 ? 0 : 0.1;
  }
  return mesh;
}

TestMesh lattice(Random& random, std::size_t vertices) {
  TestMesh mesh = make_grid(side(vertices), side(vertices), false);
  for (std::size_t v = 0; v < mesh.size(); ++v) mesh.positions[3 * v + 2] = static_cast<double>(random.below(4));
  return mesh;
}

constexpr auto kSurfaces = std::to_array<Family>({
    {"triangle grid", triangle_grid},
    {"quad grid", quad_grid},
    {"noisy grid", noisy_grid},
    {"sphere", sphere},
    {"torus", torus},
    {"moebius", moebius},
    {"pleated sheet", pleated_sheet},
    {"touching sheets", touching_sheets},
    {"lattice", lattice},
});

}  // namespace

std::span<const Family> surface_families() { return kSurfaces; }

}  // namespace meshhood::test
