// SPDX-License-Identifier: MIT
#include "methods.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/search.h"

namespace meshhood::cli {
namespace {

/// The median of up to twenty runs, and of no more than fit into 20 ms. The first, which finds nothing in its place,
/// does not count.
template <class Ask>
double median_seconds(Ask&& ask) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds kPatience{0.02};
  constexpr std::size_t kRuns = 20;
  ask();
  std::vector<Seconds> runs;
  for (Seconds spent{0}; runs.size() < kRuns && spent < kPatience; spent += runs.back()) {
    const auto start = std::chrono::steady_clock::now();
    ask();
    runs.emplace_back(std::chrono::steady_clock::now() - start);
  }
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end());
  return middle->count();
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
                                      std::vector<VertexId>& out) { vertices_in_ball(positions, v, radius, out); },
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

double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out) {
  const double seconds = median_seconds([&] { method.neighborhood(v, radius, out); });
  std::sort(out.begin(), out.end());
  return seconds;
}

double timed_count(const Method& method, VertexId v, double radius, std::size_t& out) {
  return median_seconds([&] { out = method.count(v, radius); });
}

}  // namespace meshhood::cli
