// SPDX-License-Identifier: MIT
#include "exact/weighted_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include "base/adjacency.h"
#include "exact/layout.h"
#include "exact/neighbors.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Calls `f(k, length)` for the edges `k` of a vertex.
template <class Real, class F>
void for_each_length(const Adjacency& edges, std::span<const Real> xyz, std::size_t vertex, F&& f) {
  const Point from = point(xyz, vertex);
  for (std::size_t k = edges.offsets[vertex]; k < edges.offsets[vertex + 1]; ++k) {
    f(k, std::sqrt(squared_distance(from, point(xyz, edges.neighbors[k]))));
  }
}

WeightedGraph make_weighted_graph(const IndexView& index, std::shared_ptr<const Adjacency> edges) {
  std::vector<double> lengths(edges->neighbors.size());
  std::visit(
      [&](auto xyz) {
        for (std::size_t v = 0; v < index.vertex_count(); ++v) {
          for_each_length(*edges, xyz, v, [&](std::size_t k, double length) { lengths[k] = length; });
        }
      },
      index.positions);
  return {std::move(edges), std::move(lengths)};
}

}  // namespace

Adjacency gather_edges(const IndexView& index, std::span<const VertexId> names, TaskContext& task) {
  const auto name = [&](std::size_t v) { return names.empty() ? static_cast<VertexId>(v) : names[v]; };
  Adjacency result = gather_rows(index.vertex_count(), [&](auto&& f) {
    for_each_edge(index, [&](std::size_t from, std::size_t to) {
      poll_cancel(task, from);
      f(name(from), name(to));
    });
  });
  for (std::size_t v = 0; v < index.vertex_count(); ++v) {
    poll_cancel(task, v);
    std::sort(result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v]),
              result.neighbors.begin() + static_cast<std::ptrdiff_t>(result.offsets[v + 1]));
  }
  return result;
}

KeptGraph::KeptGraph(std::shared_ptr<const Adjacency> edges) {
  if (edges) edges_.get([&] { return std::move(edges); });
}

KeptGraph::KeptGraph(std::shared_ptr<const Adjacency> edges, WeightedGraph paths) : KeptGraph(std::move(edges)) {
  paths_.get([&] { return std::move(paths); });
}

const std::shared_ptr<const Adjacency>& KeptGraph::edges_of(const IndexView& index) {
  return edges_.get([&] {
    TaskContext task;
    return std::make_shared<const Adjacency>(gather_edges(index, {}, task));
  });
}

const WeightedGraph& KeptGraph::paths_of(const IndexView& index) {
  return paths_.get([&] { return make_weighted_graph(index, edges_of(index)); });
}

void KeptGraph::renew(const IndexView& index, std::span<const VertexId> moved) {
  WeightedGraph* const graph = paths_.made();
  if (graph == nullptr) return;
  const auto renew_row = [&](auto xyz, VertexId v) {
    for_each_length(*graph->edges, xyz, v, [&](std::size_t k, double length) {
      const VertexId to = graph->edges->neighbors[k];
      const std::span<const VertexId> row = graph->edges->view()[to];
      const auto back = static_cast<std::size_t>(std::ranges::lower_bound(row, v) - row.begin());
      graph->lengths[k] = graph->lengths[graph->edges->offsets[to] + back] = length;
    });
  };
  std::visit([&](auto xyz) { std::ranges::for_each(moved, [&](VertexId v) { renew_row(xyz, v); }); }, index.positions);
}

}  // namespace meshhood::inline v0_1
