// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "contestants.h"

namespace meshhood::bench {

/// Processor time per row in microseconds, for each block; one thread.
struct BatchTimes {
  double radius_edges;
  std::size_t rows;  ///< of a batch
  std::vector<double> bfs;
  std::vector<double> bfs_reordered;
  std::vector<double> ids;
  std::vector<double> count;
};

/// Times batches of consecutive vertices of the mesh, and breadth-first search for the first vertices of each, in
/// alternating blocks.
///
/// unit    the mean edge length, in the unit of the positions.
[[nodiscard]] BatchTimes time_batches(Contestants& contestants, const Index& index, double radius_edges, double unit);

}  // namespace meshhood::bench
