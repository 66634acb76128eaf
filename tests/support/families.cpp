// SPDX-License-Identifier: MIT
#include "support/families.h"

#include <string>

namespace meshhood::test {
namespace {

/// The corner of the grid at a row and region that may be one past the last.
std::uint32_t wrapped(const GridFaces& grid, std::size_t row, std::size_t region) {
  return static_cast<std::uint32_t>((row % grid.rows) * grid.regions + region % grid.regions);
}

}  // namespace

void add_grid_faces(TestMesh& mesh, const GridFaces& grid) {
  const std::size_t last_row = grid.closed_columns ? grid.rows : grid.rows - 1;
  const std::size_t last_column = grid.closed_rows ? grid.regions : grid.regions - 1;
  for (std::size_t r = 0; r < last_row; ++r) {
    for (std::size_t c = 0; c < last_column; ++c) {
      const std::uint32_t a = wrapped(grid, r, c);
      const std::uint32_t b = wrapped(grid, r, c + 1);
      const std::uint32_t d = wrapped(grid, r + 1, c + 1);
      const std::uint32_t e = wrapped(grid, r + 1, c);
      if (grid.quads) {
        mesh.add_face({a, b, d, e});
      } else {
        mesh.add_face({a, b, d});
        mesh.add_face({a, d, e});
      }
    }
  }
}

TestMesh make_grid(std::size_t rows, std::size_t regions, bool quads) {
  TestMesh mesh;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < regions; ++c) mesh.add_vertex(static_cast<double>(c), static_cast<double>(r), 0);
  }
  add_grid_faces(mesh, {.rows = rows, .regions = regions, .quads = quads});
  return mesh.finish(true);
}

TestMesh bumpy_grid(std::size_t side) {
  Random random(4);
  TestMesh mesh = make_grid(side, side, false);
  for (double& x : mesh.positions) x += random.uniform(-0.2, 0.2);
  return mesh.finish(true);
}

void append(TestMesh& mesh, const TestMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    std::vector<std::uint32_t> face(other.face(f).begin(), other.face(f).end());
    for (std::uint32_t& corner : face) corner += first;
    mesh.add_face(face);
  }
  mesh.finish(mesh.single_precision);
}

TestMesh renumbered(const TestMesh& mesh, std::span<const std::uint32_t> place) {
  TestMesh result = mesh;
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    for (std::size_t i = 0; i < 3; ++i) result.positions[3 * std::size_t{place[v]} + i] = mesh.positions[3 * v + i];
  }
  for (std::uint32_t& corner : result.corners) corner = place[corner];
  return result.finish(mesh.single_precision);
}

std::vector<Family> families() {
  std::vector<Family> all;
  for (const auto some : {surface_families(), trap_families(), extreme_families()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TestMesh make_mesh(const Family& family, std::uint64_t seed, std::size_t vertices) {
  Random random(seed * 1000003 + vertices);
  TestMesh mesh = family.make(random, vertices);
  mesh.finish(family.either_precision && random.below(3) != 0);
  if (random.below(2) == 0) mesh = renumbered(mesh, random.permutation(mesh.size()));
  mesh.name = std::string(family.name) + ", seed " + std::to_string(seed) + ", " + std::to_string(mesh.size()) +
              " vertices, " + (mesh.single_precision ? "float" : "double");
  return mesh;
}

}  // namespace meshhood::test
