// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts/chunked_mesh.h"

namespace meshhood::parts {

/// The positions of the vertices of some faces. Where the ids lie close together, as in scans, all vertices between the
/// smallest and the largest are read, and looked up directly; otherwise those that occur, looked up by binary search.
/// Memory: at most about 40 bytes a corner.
class CornerPositions {
 public:
  CornerPositions(ChunkedMesh& mesh, const FaceChunk& faces);

  /// The position of a vertex that is a corner.
  [[nodiscard]] const Point& operator[](std::uint64_t id) const;

 private:
  void read_sparse(ChunkedMesh& mesh, const FaceChunk& faces);

  std::uint64_t first_ = 0;         // of the ids, if they are dense
  std::vector<std::uint64_t> ids_;  // ascending; empty if they are dense
  std::vector<Point> positions_;
};

}  // namespace meshhood::parts
