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

/// Small meshes of every kind that has troubled mesh programs, by formula and seed.
namespace meshhood::test {

struct Family {
  std::string_view name;

  /// About `vertices` vertices, where the family has a choice.
  TestMesh (*make)(Random& random, std::size_t vertices);

  /// Positions in either precision; otherwise only as doubles.
  bool either_precision = true;

  /// How GoogleTest names it: without this, by the bytes of its pointers.
  friend void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }
};

[[nodiscard]] std::span<const Family> surface_families();  ///< well-behaved surfaces
[[nodiscard]] std::span<const Family> trap_families();     ///< graphs and shapes with a trap for a search or a build
[[nodiscard]] std::span<const Family> extreme_families();  ///< coordinates and faces at the edge of what is allowed

/// All of the above.
[[nodiscard]] std::vector<Family> families();

/// The mesh of `family` that belongs to `seed`: precision, and whether the vertices are shuffled, are drawn from it.
[[nodiscard]] TestMesh make_mesh(const Family& family, std::uint64_t seed, std::size_t vertices);

/// Vertex `v` of `mesh` becomes vertex `place[v]`.
[[nodiscard]] TestMesh renumbered(const TestMesh& mesh, std::span<const std::uint32_t> place);

/// Vertices and faces of `other` after those of `mesh`.
void append(TestMesh& mesh, const TestMesh& other);

/// A grid of `rows` by `regions` vertices in the plane z = 0, a unit apart, in triangles or in quads.
[[nodiscard]] TestMesh make_grid(std::size_t rows, std::size_t regions, bool quads);

/// The faces of a grid whose rows, and regions, may close upon themselves.
struct GridFaces {
  std::size_t rows;
  std::size_t regions;
  bool closed_rows = false;  ///< the last vertex of a row is joined with its first
  bool closed_columns = false;
  bool quads = false;
};
void add_grid_faces(TestMesh& mesh, const GridFaces& grid);

}  // namespace meshhood::test
