// SPDX-License-Identifier: MIT
// Makes the graph of the mesh from the leaves and the links between them.

#include <algorithm>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "exact/index_access.h"
#include "exact/neighbors.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {
namespace {

/// Returns the positions in the caller's order.
PositionsData positions_of(const IndexView& index, TaskContext& task) {
  return std::visit(
      [&]<class Real>(std::span<const Real> xyz) -> PositionsData {
        std::vector<Real> result(3 * index.vertex_count());
        for (std::size_t i = 0; i < index.vertex_count(); ++i) {
          poll_cancel(task, i);
          std::copy_n(&xyz[3 * i], 3, &result[3 * std::size_t{index.id(i)}]);
        }
        return result;
      },
      index.positions);
}

}  // namespace

GraphData extract_graph(const IndexView& index, TaskContext& task) {
  return {positions_of(index, task), gather_edges(index, index.permutation, task)};
}

GraphData extract_graph(const Index& index) {
  TaskContext task;
  return extract_graph(IndexAccess::view(index), task);
}

double mean_edge_length(const Index& index) {
  const GraphData graph = extract_graph(index);
  return mean_edge_length(graph.view());
}

Fingerprint fingerprint(const Index& index, TaskContext& task) {
  const GraphData graph = extract_graph(IndexAccess::view(index), task);
  return fingerprint(graph.view());
}

Fingerprint fingerprint(const Index& index) {
  TaskContext task;
  return fingerprint(index, task);
}

}  // namespace meshhood::inline v0_1
