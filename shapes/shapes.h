// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "meshhood/mesh.h"

/// Meshes made by formula, each with a known trap for a neighbourhood search. For benchmarks, tests and the demo.
namespace meshhood::shapes {

/// A mesh of float positions and polygons, owned.
struct Shape {
  std::vector<float> positions;        ///< #V by 3
  std::vector<std::uint64_t> offsets;  ///< #F + 1, or empty where every face is a triangle
  std::vector<std::uint32_t> corners;

  [[nodiscard]] MeshView view() const;
};

struct Kind {
  std::string_view name;
  std::string_view trap;  ///< one line: what it is and where a search goes wrong on it
  Shape (*make)(std::size_t vertices);
};

/// Every kind, in the order of their names.
[[nodiscard]] const std::vector<Kind>& kinds();

/// The kind called `name`, or null.
[[nodiscard]] const Kind* find_kind(std::string_view name);

}  // namespace meshhood::shapes
