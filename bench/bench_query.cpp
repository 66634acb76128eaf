// SPDX-License-Identifier: MIT
// The time of one query, by method and radius, for vertices all over a shape.
#include <cstddef>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "meshhood/meshhood.h"

#include "shapes/shapes.h"

namespace meshhood {
namespace {

constexpr std::size_t kVertices = 200'000;
constexpr std::size_t kStride = 7919;  // a prime, so that all vertices are used and consecutive ones are far apart

/// Runs `answer(v, radius, out)` for one vertex after the other; the radius is the argument of the benchmark.
template <class F>
void time_queries(benchmark::State& state, F&& answer) {
  const auto radius = static_cast<double>(state.range(0));
  std::vector<VertexId> out;
  std::size_t v = 0;
  std::size_t found = 0;
  for (auto _ : state) {
    v = (v + kStride) % kVertices;
    answer(static_cast<VertexId>(v), radius, out);
    found += out.size();
  }
  state.counters["found"] = benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}

void bm_bfs(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shapes::find_kind(kind)->make(kVertices);
  ReferenceSearcher searcher(mesh.view());
  time_queries(state, [&](VertexId v, double radius, auto& out) { searcher.neighborhood(v, radius, out); });
}

void bm_ball(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shapes::find_kind(kind)->make(kVertices);
  BallSearcher searcher(mesh.view().positions);
  time_queries(state, [&](VertexId v, double radius, auto& out) { searcher.neighborhood(v, radius, out); });
}

void bm_exact(benchmark::State& state, const std::string& kind) {
  const Index index = build(shapes::find_kind(kind)->make(kVertices).view());
  Searcher searcher(index);
  time_queries(state, [&](VertexId v, double radius, auto& out) { searcher.neighborhood(v, radius, out); });
}

void bm_paper(benchmark::State& state, const std::string& kind) {
  const paper::Index index = paper::build(shapes::find_kind(kind)->make(kVertices).view());
  paper::Searcher searcher(index);
  time_queries(state, [&](VertexId v, double radius, auto& out) { searcher.neighborhood(v, radius, out); });
}

BENCHMARK_CAPTURE(bm_bfs, sphere, "sphere")->Arg(2)->Arg(10)->Arg(40);
BENCHMARK_CAPTURE(bm_bfs, scroll, "scroll")->Arg(2)->Arg(10)->Arg(40);
BENCHMARK_CAPTURE(bm_ball, sphere, "sphere")->Arg(10);
BENCHMARK_CAPTURE(bm_exact, sphere, "sphere")->Arg(2)->Arg(10)->Arg(40);
BENCHMARK_CAPTURE(bm_exact, scroll, "scroll")->Arg(2)->Arg(10)->Arg(40);
BENCHMARK_CAPTURE(bm_paper, sphere, "sphere")->Arg(2)->Arg(10)->Arg(40);
BENCHMARK_CAPTURE(bm_paper, scroll, "scroll")->Arg(2)->Arg(10)->Arg(40);

}  // namespace
}  // namespace meshhood
