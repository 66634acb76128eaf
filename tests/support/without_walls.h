// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/adjacency.h"
#include "meshhood/masks.h"

#include "support/test_mesh.h"

namespace meshhood::test {

/// The graph of a mesh without the edges at walls: a search of it that begins at another vertex reaches no wall.
inline Adjacency without_walls(const TestMesh& mesh, const VertexMask& walls) {
  const Adjacency all = adjacency(mesh.view());
  if (walls.size() == 0) return all;
  Adjacency result{{0}, {}};
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    for (const VertexId w : all.view()[v]) {
      if (!walls[static_cast<VertexId>(v)] && !walls[w]) result.neighbors.push_back(w);
    }
    result.offsets.push_back(static_cast<decltype(result.offsets)::value_type>(result.neighbors.size()));
  }
  return result;
}

}  // namespace meshhood::test
