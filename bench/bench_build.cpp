// SPDX-License-Identifier: MIT
// The time to build the adjacency and both indexes, on different shapes.
#include <cstddef>
#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>

#include "meshhood/meshhood.h"

#include "shapes/shapes.h"

namespace meshhood {
namespace {

shapes::Shape shape(const std::string& kind, const benchmark::State& state) {
  return shapes::find_kind(kind)->make(static_cast<std::size_t>(state.range(0)));
}

void count_vertices(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * state.range(0)); }

void bm_adjacency(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shape(kind, state);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(adjacency(mesh.view()));
  count_vertices(state);
}

void bm_exact(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shape(kind, state);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(build(mesh.view(), {.threads = 1}));
  count_vertices(state);
}

void bm_paper(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shape(kind, state);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(paper::build(mesh.view()));
  count_vertices(state);
}

BENCHMARK_CAPTURE(bm_adjacency, sphere, "sphere")->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(bm_exact, sphere, "sphere")->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(bm_exact, noise, "noise")->Arg(100000);
BENCHMARK_CAPTURE(bm_exact, soup, "soup")->Arg(100000);
BENCHMARK_CAPTURE(bm_exact, star, "star")->Arg(100000);
BENCHMARK_CAPTURE(bm_exact, path, "path")->Arg(100000);
BENCHMARK_CAPTURE(bm_paper, sphere, "sphere")->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(bm_paper, noise, "noise")->Arg(100000);
BENCHMARK_CAPTURE(bm_paper, soup, "soup")->Arg(100000);
BENCHMARK_CAPTURE(bm_paper, star, "star")->Arg(100000);
BENCHMARK_CAPTURE(bm_paper, path, "path")->Arg(100000);

}  // namespace
}  // namespace meshhood
