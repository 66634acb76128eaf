// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parts/chunked_mesh.h"
#include "parts/corner_positions.h"
#include "parts/cut_tree.h"
#include "parts/part_writer.h"
#include "parts/stages.h"

namespace meshhood::parts {

/// Distributes a mesh over its parts. A part gets every vertex within the halo of one that it owns, every face with
/// such a corner, and the other corners of these faces as its fringe.
class Distribution {
 public:
  /// All arguments are borrowed. `tree` has all vertices. Parts that are `finished` get nothing.
  Distribution(ChunkedMesh& mesh, const CutTree& tree, double halo, const std::vector<bool>& finished,
               PartContents& contents);

  /// Adds the vertices. Returns the number of vertices of each part, finished or not, without its fringe.
  [[nodiscard]] std::vector<std::uint64_t> add_vertices(Stages& stages);

  /// Adds the faces and the fringes, `chunk_corners` corners at a time, of `corners` in all.
  void add_faces(std::size_t chunk_corners, std::uint64_t corners, Stages& stages);

 private:
  class CornerParts;

  void add_face(std::span<const std::uint64_t> face, const CornerPositions& vertices, const CornerParts& parts);

  ChunkedMesh& mesh_;
  const CutTree& tree_;
  double squared_halo_;
  const std::vector<bool>& finished_;
  PartContents& contents_;
  std::vector<std::uint32_t> takers_;  // the parts of the current face
};

}  // namespace meshhood::parts
