// SPDX-License-Identifier: MIT
// How long the index takes to build, and its adjacency alone, on shapes with different traps.
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
  for (auto _ : state) benchmark::DoNotOptimize(adjacency(mesh.view()));
  count_vertices(state);
}

void bm_build(benchmark::State& state, const std::string& kind) {
  const shapes::Shape mesh = shape(kind, state);
  for (auto _ : state) benchmark::DoNotOptimize(paper::build(mesh.view()));
  count_vertices(state);
}

BENCHMARK_CAPTURE(bm_adjacency, sphere, "sphere")->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(bm_build, sphere, "sphere")->Arg(10000)->Arg(100000);
BENCHMARK_CAPTURE(bm_build, noise, "noise")->Arg(100000);
BENCHMARK_CAPTURE(bm_build, soup, "soup")->Arg(100000);
BENCHMARK_CAPTURE(bm_build, star, "star")->Arg(100000);
BENCHMARK_CAPTURE(bm_build, path, "path")->Arg(100000);

}  // namespace
}  // namespace meshhood
