// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/paper.h"

#include "base/distance.h"

namespace meshhood::paper {

/// A level in the making (3.2): what the step from one level to the next reads of it.
struct DraftLevel {
  AdjacencyView siblings;              // of every cluster; on the base level the graph of the mesh itself
  Adjacency own_siblings;              // what `siblings` refers to above the base level
  std::vector<VertexId> vertex_count;  // by cluster
  std::vector<Point> position_sum;     // by cluster: the sum over its vertices, from which fusion has their mean

  [[nodiscard]] std::size_t size() const { return vertex_count.size(); }
};

/// To which cluster of the next level each cluster goes.
struct Partition {
  std::vector<ClusterId> parent;
  std::size_t clusters = 0;
};

inline constexpr ClusterId kNoCluster = static_cast<ClusterId>(-1);

}  // namespace meshhood::paper
