// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "meshhood/mesh.h"

/// Meshes made by formula, each with a known trap for a neighborhood search. For benchmarks, tests and the demo.
///
/// The unit of length is about one edge. The same kind and number of vertices give the same bytes on every platform:
/// only the four operations and square roots are used, which IEEE 754 defines to the last bit.
namespace meshhood::shapes {

/// A mesh of float positions and polygons, owned.
struct Shape {
  std::vector<float> positions;        ///< #V by 3
  std::vector<std::uint64_t> offsets;  ///< #F + 1, or empty where every face is a triangle
  std::vector<std::uint32_t> corners;

  /// Borrows from this shape.
  [[nodiscard]] MeshView view() const;
};

struct Kind {
  std::string_view name;
  std::string_view trap;             ///< one line: what it is and where a search goes wrong on it
  std::size_t minimum;               ///< the fewest vertices it can be made of
  Shape (*generate)(std::size_t n);  ///< `make` without the checks

  /// The shape with `vertices` vertices; where the kind is made of rings (knot), of whole hexagons (ngons) or of
  /// layers (gyroid), with the nearest number that comes out even, within 5 % from a thousand vertices on.
  ///
  /// Throws Error{InvalidOption} below `minimum`, Error{TooLarge} above `kMaxVertices`. O(vertices).
  [[nodiscard]] Shape make(std::size_t vertices) const;
};

/// Every kind, in the order of their names.
[[nodiscard]] const std::vector<Kind>& kinds();

/// The kind called `name`, or null.
[[nodiscard]] const Kind* find_kind(std::string_view name);

}  // namespace meshhood::shapes
