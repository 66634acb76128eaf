// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace meshhood {

/// A level of an index, in figures.
struct LevelSummary {
  int level;             ///< its number; that of the leaves, or in the paper's index of single vertices, is 0
  std::size_t clusters;  ///< how many: leaves, or nodes above them
  double mean_vertices;  ///< vertices a cluster
  double mean_radius;    ///< of the bounding spheres, in the unit of the positions: `ar` of the paper's sec. 3.3
  double mean_siblings;  ///< siblings a cluster; 0 where none are kept, as above the leaves of the exact index
  std::size_t bytes;     ///< memory of the level's arrays
};

}  // namespace meshhood
