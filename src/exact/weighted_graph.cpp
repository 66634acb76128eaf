// SPDX-License-Identifier: MIT
#include "exact/weighted_graph.h"

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include "base/adjacency.h"
#include "base/distance.h"
#include "exact/layout.h"
#include "exact/neighbors.h"

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

}  // namespace

WeightedGraph make_weighted_graph(const IndexView& index) {
  // Each edge is gathered at its end: edges are visited leaf by leaf, ascending, so that rows ascend.
  Adjacency edges = gather_rows(index.vertex_count(), [&](auto&& f) {
    for_each_edge(index,
                  // mutant: rows-of-a-graph-do-not-ascend
                  [&](std::size_t from, std::size_t to) { f(static_cast<VertexId>(to), static_cast<VertexId>(from)); });
  });
  std::vector<double> lengths = std::visit([&](auto xyz) { return lengths_of(edges, xyz); }, index.positions);
  return {std::move(edges), std::move(lengths)};
}

}  // namespace meshhood
