// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/paper.h"

#include "shared/distance.h"

namespace meshhood::paper {

/// A level during construction (3.2): what the computation of the next level needs.
struct DraftLevel {
  AdjacencyView siblings;              // of each cluster; on the base level, the graph of the mesh
  Adjacency own_siblings;              // what `siblings` refers to, above the base level
  std::vector<VertexId> vertex_count;  // by cluster
  std::vector<Point> position_sum;     // by cluster: the sum over its vertices; fusion needs the mean

  [[nodiscard]] std::size_t size() const { return vertex_count.size(); }
};

/// The parent of each cluster, on the next level.
struct Partition {
  std::vector<ClusterId> parent;
  std::size_t clusters = 0;
};

inline constexpr ClusterId kNoCluster = static_cast<ClusterId>(-1);

}  // namespace meshhood::paper
