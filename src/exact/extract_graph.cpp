// SPDX-License-Identifier: MIT
// The graph of the mesh, from the leaves and the links between them.
#include "exact/extract_graph.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "meshhood/index.h"

#include "base/adjacency.h"
#include "exact/index_access.h"

namespace meshhood {
namespace {

/// Called for every vertex; polls seldom enough to cost nothing.
void poll_cancel(TaskContext& task, std::size_t vertex) {
  constexpr std::size_t kInterval = 1024;
  if (vertex % kInterval == 0) task.should_continue(0);
}

/// The positions in the caller's order.
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

/// Calls `f(v, w)` for every edge in both directions, by the caller's ids.
template <class F>
void for_each_neighbor(const IndexView& index, TaskContext& task, F&& f) {
  for (std::size_t leaf = 0; leaf < index.leaf_count(); ++leaf) {
    const std::size_t begin = index.leaf_begin[leaf];
    for (std::size_t i = begin; i < index.leaf_begin[leaf + 1]; ++i) {
      poll_cancel(task, i);
      for (LaneMask left = index.adjacency[i]; left != 0; left &= left - 1) {
        f(index.id(i), index.id(begin + static_cast<std::size_t>(std::countr_zero(left))));
      }
    }
    for (const Link& link : index.links_of(leaf)) {
      const std::size_t other = index.leaf_begin[link.leaf];
      for (const CrossEdge& edge : index.cross_edges_of(link))
        f(index.id(begin + edge.from), index.id(other + edge.to));
    }
  }
}

Adjacency adjacency_of(const IndexView& index, TaskContext& task) {
  Adjacency result = gather_rows(index.vertex_count(), [&](auto&& f) { for_each_neighbor(index, task, f); });
  for (std::size_t v = 0; v < index.vertex_count(); ++v) {
    poll_cancel(task, v);
    std::sort(result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v]),
              result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v + 1]));
  }
  return result;
}

}  // namespace

GraphData extract_graph(const Index& index, TaskContext& task) {
  const IndexView& view = IndexAccess::view(index);
  return {positions_of(view, task), adjacency_of(view, task)};
}

GraphData extract_graph(const Index& index) {
  TaskContext task;
  return extract_graph(index, task);
}

Fingerprint fingerprint(const Index& index, TaskContext& task) {
  const GraphData graph = extract_graph(index, task);
  return fingerprint(graph.view());
}

Fingerprint fingerprint(const Index& index) {
  TaskContext task;
  return fingerprint(index, task);
}

}  // namespace meshhood
