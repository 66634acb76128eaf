// SPDX-License-Identifier: MIT
#include "methods.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "meshhood/reference.h"
#include "meshhood/search.h"

namespace meshhood::cli {
namespace {

/// The fastest of up to twenty runs, and of no more than fit into 20 ms, for a single one may be disturbed. The first,
/// which finds nothing in its place, does not count.
template <class Ask>
double fastest(Ask&& ask) {
  using Seconds = std::chrono::duration<double>;
  constexpr Seconds kPatience{0.02};
  constexpr int kRuns = 20;
  ask();
  Seconds best = Seconds::max();
  Seconds spent{0};
  for (int run = 0; run < kRuns && spent < kPatience; ++run) {
    const auto start = std::chrono::steady_clock::now();
    ask();
    const Seconds elapsed = std::chrono::steady_clock::now() - start;
    best = std::min(best, elapsed);
    spent += elapsed;
  }
  return best.count();
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

double timed_query(const Method& method, VertexId v, double radius, std::vector<VertexId>& out) {
  const double seconds = fastest([&] { method.neighborhood(v, radius, out); });
  std::sort(out.begin(), out.end());
  return seconds;
}

double timed_count(const Method& method, VertexId v, double radius, std::size_t& out) {
  return fastest([&] { out = method.count(v, radius); });
}

}  // namespace meshhood::cli
