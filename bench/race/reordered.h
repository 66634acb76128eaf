// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "meshhood/meshhood.h"

namespace meshhood::bench {

/// The graph of a mesh with its vertices in another order, and positions as floats.
struct Reordered {
  std::vector<float> positions;
  Adjacency adjacency;
  std::vector<VertexId> new_id;  ///< of each vertex of the mesh

  Reordered(const GraphView& graph, std::span<const VertexId> order) : new_id(order.size()) {
    for (std::size_t i = 0; i < order.size(); ++i) new_id[order[i]] = static_cast<VertexId>(i);
    adjacency.offsets.push_back(0);
    for (const VertexId v : order) {
      add_position(graph.positions, v);
      add_row(graph.adjacency[v]);
    }
  }

  [[nodiscard]] GraphView view() const { return {positions, adjacency.view()}; }

 private:
  void add_position(const PositionsView& from, VertexId v) {
    from.visit([&](const auto& xyz) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        positions.push_back(static_cast<float>(xyz(v, axis)));
      }
    });
  }

  void add_row(std::span<const VertexId> neighbors) {
    const auto row = static_cast<std::ptrdiff_t>(adjacency.neighbors.size());
    for (const VertexId w : neighbors) adjacency.neighbors.push_back(new_id[w]);
    std::sort(adjacency.neighbors.begin() + row, adjacency.neighbors.end());
    adjacency.offsets.push_back(static_cast<EdgeOffset>(adjacency.neighbors.size()));
  }
};

}  // namespace meshhood::bench
