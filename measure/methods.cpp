// SPDX-License-Identifier: MIT
#include "measure/methods.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/search.h"
#include "meshhood/searcher.h"

namespace meshhood::measure {
namespace {

template <NeighborhoodSearcher Searcher>
Method make_method(std::string name, Searcher searcher) {
  const auto shared = std::make_shared<Searcher>(std::move(searcher));
  return {.name = std::move(name),
          .neighborhood = [shared](VertexId v, double radius,
                                   std::vector<VertexId>& out) { shared->neighborhood(v, radius, out); },
          .count = [shared](VertexId v, double radius) { return shared->count(v, radius); }};
}

}  // namespace

Method exact_method(const Index& index) { return make_method("exact", Searcher(index)); }

Method bfs_method(const GraphView& graph) { return make_method("bfs", ReferenceSearcher(graph)); }

Method ball_method(const PositionsView& positions) {
  Method method = make_method("ball", BallSearcher(positions));
  method.visits_all_vertices = true;
  return method;
}

Method paper_method(const paper::Index& index, const paper::QueryOptions& options) {
  return make_method("paper", paper::Searcher(index, options));
}

}  // namespace meshhood::measure
