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

namespace meshhood::cli {

/// One way to answer a query, ready to be asked many times.
struct Method {
  std::string name;
  std::function<void(VertexId v, double radius, std::vector<VertexId>& out)> neighborhood;
  std::function<std::size_t(VertexId v, double radius)> count;  ///< none where the vertices must be listed for it
  bool visits_all_vertices = false;                             ///< each query costs as much as the whole mesh
  bool lists_vertices = true;                                   ///< else `neighborhood` leaves `out` as it was
};

/// The exact answer, by the index made for it. Borrows `index`.
[[nodiscard]] Method exact_method(const Index& index);

/// The exact answer, by breadth-first search. Borrows `graph`.
[[nodiscard]] Method bfs_method(const GraphView& graph);

/// Whatever lies in the ball. Borrows `positions`.
[[nodiscard]] Method ball_method(const PositionsView& positions);

/// The paper's answer. Borrows `index`.
[[nodiscard]] Method paper_method(const paper::Index& index, const paper::QueryOptions& options = {});

/// Asks some times, the first so that everything is in its place, and returns the median of the seconds that the others
/// took. `out` is the answer, ascending.
double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out);

/// The same by `method.count`.
double timed_count(const Method& method, VertexId v, double radius, std::size_t& out);

}  // namespace meshhood::cli
