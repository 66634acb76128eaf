// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "contestants.h"

namespace meshhood::bench {

/// Microseconds a row of processor time, block by block: one thread.
struct BatchTimes {
  double radius_edges;
  std::size_t rows;  ///< of a batch
  std::vector<double> bfs;
  std::vector<double> bfs_reordered;
  std::vector<double> ids;
  std::vector<double> count;
};

/// Batches over runs of vertices as the mesh numbers them, and breadth-first search over the first vertices of each, as
/// many as there is time for; the blocks in turn.
///
/// unit    one average edge, in the unit of the positions.
[[nodiscard]] BatchTimes time_batches(Contestants& contestants, const Index& index, double radius_edges, double unit);

}  // namespace meshhood::bench
