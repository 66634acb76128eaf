// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"

namespace meshhood::cli {

/// One way to answer a query, ready to be asked many times.
struct Method {
  std::string name;
  std::function<void(VertexId v, double radius, std::vector<VertexId>& out)> neighborhood;
  bool visits_all_vertices = false;  ///< each query costs as much as the whole mesh
};

/// The exact answer, by breadth-first search. Borrows `graph`.
[[nodiscard]] Method bfs_method(const GraphView& graph);

/// Whatever lies in the ball. Borrows `positions`.
[[nodiscard]] Method ball_method(const PositionsView& positions);

/// The paper's answer. Borrows `index`.
[[nodiscard]] Method paper_method(const paper::Index& index, const paper::QueryOptions& options = {});

/// Builds the paper's index, with progress for the impatient.
[[nodiscard]] paper::Index build_index(const MeshView& mesh);

/// Asks twice, so that the second time finds everything in its place, and returns how many seconds that took. `out` is
/// the answer, ascending.
double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out);

}  // namespace meshhood::cli
