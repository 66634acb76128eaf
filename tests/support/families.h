// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "support/random.h"
#include "support/test_mesh.h"

/// Small meshes of every kind that is known to cause errors in mesh programs, by formula and seed.
namespace meshhood::test {

struct Family {
  std::string_view name;

  /// About `vertices` vertices, if the family has a choice.
  TestMesh (*make)(Random& random, std::size_t vertices);

  /// Positions of either precision; otherwise only double.
  bool either_precision = true;

  /// For GoogleTest, which would otherwise print the bytes of the pointers.
  friend void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }
};

[[nodiscard]] std::span<const Family> surface_families();  ///< well-behaved surfaces
[[nodiscard]] std::span<const Family> trap_families();     ///< graphs and shapes that are difficult to search
[[nodiscard]] std::span<const Family> extreme_families();  ///< coordinates and faces at the limits of what is allowed

/// All of the above.
[[nodiscard]] std::vector<Family> families();

/// The mesh of `family` for `seed`, which also determines the precision and whether the vertices are shuffled.
[[nodiscard]] TestMesh make_mesh(const Family& family, std::uint64_t seed, std::size_t vertices);

/// Vertex `v` of `mesh` becomes vertex `place[v]`.
[[nodiscard]] TestMesh renumbered(const TestMesh& mesh, std::span<const std::uint32_t> place);

/// Appends the vertices and faces of `other` to those of `mesh`.
void append(TestMesh& mesh, const TestMesh& other);

/// A grid of `rows` by `regions` vertices in the plane z = 0, a unit apart, in triangles or in quads.
[[nodiscard]] TestMesh make_grid(std::size_t rows, std::size_t regions, bool quads);

/// A grid of triangles with `side` by `side` vertices, each moved a little.
[[nodiscard]] TestMesh bumpy_grid(std::size_t side);

/// The faces of a grid whose rows and regions may be closed.
struct GridFaces {
  std::size_t rows;
  std::size_t regions;
  bool closed_rows = false;  ///< the last vertex of a row is connected with its first
  bool closed_columns = false;
  bool quads = false;
};
void add_grid_faces(TestMesh& mesh, const GridFaces& grid);

}  // namespace meshhood::test
