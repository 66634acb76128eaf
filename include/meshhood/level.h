// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The memory of an index by part, in bytes; for a mapped index, bytes of the file.
struct IndexBytes {
  std::size_t positions = 0;    ///< coordinates of the vertices
  std::size_t permutation = 0;  ///< from the caller's numbering to that of the index, and back
  std::size_t graph = 0;        ///< edges of the mesh; in the paper's index, siblings
  std::size_t tree = 0;         ///< leaves or clusters, bounding spheres, links between nodes

  [[nodiscard]] std::size_t total() const { return positions + permutation + graph + tree; }
};

/// Statistics of one level of an index. A *cluster* is a leaf of the exact index, a node above the leaves, or a cluster
/// of the paper.
struct LevelSummary {
  int level;             ///< its number; 0 are the leaves, or in the paper's index the single vertices
  std::size_t clusters;  ///< the number of clusters
  double mean_vertices;  ///< the mean number of vertices of a cluster
  double mean_radius;    ///< of the bounding spheres, in the unit of the positions: `ar` of the paper's sec. 3.3
  double mean_siblings;  ///< of a cluster; for a leaf, its links. 0 above the leaves of the exact index: not counted
  std::size_t bytes;     ///< memory of the arrays of the level
};

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
