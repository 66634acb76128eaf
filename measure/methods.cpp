// SPDX-License-Identifier: MIT
#include "measure/methods.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/search.h"

namespace meshhood::measure {

using Vertices = std::vector<VertexId>;

Method exact_method(const Index& index) {
  auto searcher = std::make_shared<Searcher>(index);
  return {
      .name = "exact",
      .neighborhood = [searcher](VertexId v, double radius, Vertices& out) { searcher->neighborhood(v, radius, out); },
      .count = [searcher](VertexId v, double radius) { return searcher->count(v, radius); }};
}

Method bfs_method(const GraphView& graph) {
  auto searcher = std::make_shared<ReferenceSearcher>(graph);
  return {
      .name = "bfs",
      .neighborhood = [searcher](VertexId v, double radius, Vertices& out) { searcher->neighborhood(v, radius, out); },
      .count = {}};
}

Method ball_method(const PositionsView& positions) {
  return {.name = "ball",
          .neighborhood = [positions](VertexId v, double radius,
                                      Vertices& out) { vertices_in_ball(positions, v, radius, out); },
          .count = {},
          .visits_all_vertices = true};
}

Method paper_method(const paper::Index& index, const paper::QueryOptions& options) {
  auto searcher = std::make_shared<paper::Searcher>(index, options);
  return {
      .name = "paper",
      .neighborhood = [searcher](VertexId v, double radius, Vertices& out) { searcher->neighborhood(v, radius, out); },
      .count = [searcher](VertexId v, double radius) { return searcher->count(v, radius); }};
}

}  // namespace meshhood::measure
