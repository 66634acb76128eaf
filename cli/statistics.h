// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood::cli {

struct Box {
  std::array<double, 3> min;
  std::array<double, 3> max;
};

/// Properties of a mesh. Edges connect vertices, not positions.
struct Statistics {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::map<std::size_t, std::size_t> polygon_degrees;  ///< number of corners -> number of faces
  std::size_t edges = 0;                               ///< distinct
  std::size_t components = 0;                          ///< connected by edges; without isolated vertices
  std::size_t isolated_vertices = 0;                   ///< in no face
  std::size_t boundary_edges = 0;                      ///< in one face
  std::size_t nonmanifold_edges = 0;                   ///< in more than two faces
  double average_edge = 0;                             ///< mean length of the distinct edges; 0 if there are none
  std::size_t repeated_corners = 0;                    ///< corners whose vertex occurs earlier in the same face
  std::size_t repeated_positions = 0;                  ///< #V minus the number of distinct positions
  std::optional<Box> bounds;                           ///< empty for a mesh without vertices
};

/// The number of components, as above. `adjacency`: that of `mesh`. O(#V + #corners).
[[nodiscard]] std::size_t count_components(const MeshView& mesh, const AdjacencyView& adjacency);

/// `adjacency`: that of `mesh`. O(#V log #V + #corners log #corners).
[[nodiscard]] Statistics statistics(const MeshView& mesh, const AdjacencyView& adjacency);

}  // namespace meshhood::cli
