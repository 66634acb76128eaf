// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts/chunked_mesh.h"
#include "parts/cut_tree.h"
#include "parts/part_writer.h"
#include "parts/passes.h"

namespace meshhood::parts {

/// Distributes a mesh over its parts. A part gets every vertex and every face within the halo of a vertex that it owns,
/// also a face whose corners are all farther away, and the other corners of these faces as its fringe.
struct Distribution {
  ChunkedMesh& mesh;
  const CutTree& tree;  ///< of all vertices
  double squared_halo;
  const std::vector<bool>& finished;  ///< which parts get nothing
  PartContents& contents;

  /// Adds the vertices. Returns the number of vertices of each part, finished or not, without its fringe.
  [[nodiscard]] std::vector<std::uint64_t> add_vertices(Stages& stages) const;

  /// Adds the faces and the fringes, `chunk_corners` corners at a time, of `corners` in all.
  void add_faces(std::size_t chunk_corners, std::uint64_t corners, Stages& stages) const;
};

}  // namespace meshhood::parts
