// SPDX-License-Identifier: MIT
#include "methods.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "progress.h"

namespace meshhood::cli {
namespace {

template <class Ask>
double seconds_of_second(Ask&& ask) {
  ask();
  const auto start = std::chrono::steady_clock::now();
  ask();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count();
}

}  // namespace

Method exact_method(const Index& index) {
  auto searcher = std::make_shared<Searcher>(index);
  return {.name = "exact",
          .neighborhood = [searcher](VertexId v, double radius,
                                     std::vector<VertexId>& out) { searcher->neighborhood(v, radius, out); },
          .count = [searcher](VertexId v, double radius) { return searcher->count(v, radius); }};
}

Method bfs_method(const GraphView& graph) {
  auto searcher = std::make_shared<ReferenceSearcher>(graph);
  return {.name = "bfs",
          .neighborhood = [searcher](VertexId v, double radius,
                                     std::vector<VertexId>& out) { searcher->neighborhood(v, radius, out); },
          .count = {}};
}

Method ball_method(const PositionsView& positions) {
  return {.name = "ball",
          .neighborhood = [positions](VertexId v, double radius,
                                      std::vector<VertexId>& out) { ball(positions, v, radius, out); },
          .count = {},
          .visits_all_vertices = true};
}

Method paper_method(const paper::Index& index, const paper::QueryOptions& options) {
  auto searcher = std::make_shared<paper::Searcher>(index);
  return {.name = "paper",
          .neighborhood = [searcher, options](
                              VertexId v, double radius,
                              std::vector<VertexId>& out) { searcher->neighborhood(v, radius, out, options); },
          .count = [searcher, options](VertexId v, double radius) { return searcher->count(v, radius, options); }};
}

Index build_exact_index(const MeshView& mesh) {
  const Progress progress("building the index");
  return build(mesh);
}

paper::Index build_paper_index(const MeshView& mesh) {
  const Progress progress("building the index of the paper");
  return paper::build(mesh);
}

double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out) {
  const double seconds = seconds_of_second([&] { method.neighborhood(v, radius, out); });
  std::sort(out.begin(), out.end());
  return seconds;
}

double timed_count(const Method& method, VertexId v, double radius, std::size_t& out) {
  return seconds_of_second([&] { out = method.count(v, radius); });
}

}  // namespace meshhood::cli
