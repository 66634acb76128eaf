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

namespace meshhood {
namespace {

template <class Real>
std::vector<double> lengths_of(const Adjacency& edges, std::span<const Real> xyz) {
  std::vector<double> lengths;
  lengths.reserve(edges.neighbors.size());
  for (std::size_t v = 0; v + 1 < edges.offsets.size(); ++v) {
    const Point from = point(xyz, v);
    for (const VertexId to : edges.view()[v]) lengths.push_back(std::sqrt(squared_distance(from, point(xyz, to))));
  }
  return lengths;
}

WeightedGraph make_weighted_graph(const IndexView& index) {
  Adjacency edges = gather_rows(index.vertex_count(), [&](auto&& f) {
    for_each_edge(index,
                  [&](std::size_t from, std::size_t to) { f(static_cast<VertexId>(from), static_cast<VertexId>(to)); });
  });
  const auto row = [&](std::size_t v) {
    return edges.neighbors.begin() + static_cast<std::ptrdiff_t>(edges.offsets[v]);
  };
  for (std::size_t v = 0; v < index.vertex_count(); ++v) {
    std::sort(row(v), row(v + 1));
  }
  std::vector<double> lengths = std::visit([&](auto xyz) { return lengths_of(edges, xyz); }, index.positions);
  return {std::move(edges), std::move(lengths)};
}

}  // namespace

const WeightedGraph& KeptGraph::of(const IndexView& index) {
  return graph_.get([&] { return make_weighted_graph(index); });
}

}  // namespace meshhood
