// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "meshhood/mesh.h"

/// Synthetic meshes, each with a known difficulty for a neighborhood search. For benchmarks, tests and the demo.
///
/// Edges have a length of about 1. The same kind and number of vertices give the same bytes on every platform:
/// only the four operations and square roots are used, which IEEE 754 defines to the last bit.
namespace meshhood::shapes {

/// A mesh of float positions and polygons, owned.
struct Shape {
  std::vector<float> positions;        ///< #V by 3
  std::vector<std::uint64_t> offsets;  ///< #F + 1, or empty if every face is a triangle
  std::vector<std::uint32_t> corners;

  /// Borrows from this shape.
  [[nodiscard]] MeshView view() const;
};

struct Kind {
  std::string_view name;
  std::string_view trap;             ///< one line: what it is and why a search may fail on it
  std::size_t minimum;               ///< the smallest number of vertices
  Shape (*generate)(std::size_t n);  ///< `make` without the checks

  /// Returns the shape with `vertices` vertices. Kinds made of rings (knot), hexagons (ngons) or layers (gyroid) have
  /// the nearest possible number, within 5 % from a thousand vertices on.
  ///
  /// Throws Error{InvalidOption} below `minimum`, Error{TooLarge} above `kMaxVertices`. O(vertices).
  [[nodiscard]] Shape make(std::size_t vertices) const;
};

/// All kinds, sorted by name.
[[nodiscard]] const std::vector<Kind>& kinds();

/// The kind with this name, or null.
[[nodiscard]] const Kind* find_kind(std::string_view name);

}  // namespace meshhood::shapes
