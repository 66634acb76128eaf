// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"

namespace meshhood::measure {

/// A named searcher of any type, for a choice at run time.
struct Method {
  std::string name;
  std::function<void(VertexId v, double radius, std::vector<VertexId>& out)> neighborhood;
  std::function<std::size_t(VertexId v, double radius)> count;
  bool visits_all_vertices = false;  ///< each query costs O(#V)
  bool lists_vertices = true;        ///< if false, `neighborhood` does not write `out`
};

/// The exact index. Borrows `index`.
[[nodiscard]] Method exact_method(const Index& index);

/// Breadth-first search, exact. Borrows `graph`.
[[nodiscard]] Method bfs_method(const GraphView& graph);

/// All vertices in the ball. Borrows `positions`.
[[nodiscard]] Method ball_method(const PositionsView& positions);

/// The paper's index. Borrows `index`.
[[nodiscard]] Method paper_method(const paper::Index& index, const paper::QueryOptions& options = {});

}  // namespace meshhood::measure
