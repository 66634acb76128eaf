// SPDX-License-Identifier: MIT
#include "methods.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "meshhood/reference.h"

#include "progress.h"

namespace meshhood::cli {

Method bfs_method(const GraphView& graph) {
  auto searcher = std::make_shared<ReferenceSearcher>(graph);
  return {.name = "bfs", .neighborhood = [searcher](VertexId v, double radius, std::vector<VertexId>& out) {
            searcher->neighborhood(v, radius, out);
          }};
}

Method ball_method(const PositionsView& positions) {
  return {.name = "ball",
          .neighborhood = [positions](VertexId v, double radius,
                                      std::vector<VertexId>& out) { ball(positions, v, radius, out); },
          .visits_all_vertices = true};
}

Method paper_method(const paper::Index& index, const paper::QueryOptions& options) {
  auto searcher = std::make_shared<paper::Searcher>(index);
  return {.name = "paper", .neighborhood = [searcher, options](VertexId v, double radius, std::vector<VertexId>& out) {
            searcher->neighborhood(v, radius, out, options);
          }};
}

paper::Index build_index(const MeshView& mesh) {
  const Progress progress("building the index");
  return paper::build(mesh);
}

double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out) {
  method.neighborhood(v, radius, out);
  const auto start = std::chrono::steady_clock::now();
  method.neighborhood(v, radius, out);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::sort(out.begin(), out.end());
  return elapsed.count();
}

}  // namespace meshhood::cli
