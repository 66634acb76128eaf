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

/// What a mesh is like. Edges are counted between vertices, not positions.
struct Statistics {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::map<std::size_t, std::size_t> polygon_degrees;  ///< corners -> how many faces have as many
  std::size_t edges = 0;                               ///< different ones
  std::size_t components = 0;                          ///< joined by edges; isolated vertices left out
  std::size_t isolated_vertices = 0;                   ///< in no face
  std::size_t boundary_edges = 0;                      ///< in one face
  std::size_t nonmanifold_edges = 0;                   ///< in more than two faces
  double average_edge = 0;                             ///< over the different edges; 0 where there is none
  std::size_t repeated_corners = 0;                    ///< corners at a vertex that their face has had before
  std::size_t repeated_positions = 0;                  ///< vertices less different positions, these rounded to float
  std::optional<Box> bounds;                           ///< none for a mesh without vertices
};

/// `adjacency`: that of `mesh`. O(#V log #V + #corners log #corners).
[[nodiscard]] Statistics statistics(const MeshView& mesh, const AdjacencyView& adjacency);

}  // namespace meshhood::cli
