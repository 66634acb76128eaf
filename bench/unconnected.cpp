// SPDX-License-Identifier: MIT
// Compares `nearest_unconnected` with `counts` for all vertices, in alternating rounds. Wall-clock microseconds for
// each vertex, and the ratio.
//
//   unconnected MESH THREADS [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

constexpr int kRounds = 3;

/// The time of the fastest round, in seconds.
template <class F>
void measure_round(double& least, F&& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

void compare(const Index& index, double edges, double mean_edge, unsigned threads) {
  const BatchQuery query{.radius = edges * mean_edge};
  const Run run{.threads = threads};
  double counting = std::numeric_limits<double>::infinity();
  double nearest = counting;
  Unconnected found;
  for (int round = 0; round < kRounds; ++round) {
    measure_round(counting, [&] { static_cast<void>(counts(index, query, run)); });
    measure_round(nearest, [&] { found = nearest_unconnected(index, query, run); });
  }
  const auto none = std::count(found.vertex.begin(), found.vertex.end(), kNoVertex);
  const auto vertices = static_cast<double>(index.vertex_count());
  std::printf("%6.4g %12.3f %12.3f %8.2f %10.1f\n", edges, 1e6 * counting / vertices, 1e6 * nearest / vertices,
              nearest / counting, 100 * (1 - static_cast<double>(none) / vertices));
  std::fflush(stdout);
}

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const auto threads = static_cast<unsigned>(std::stoul(arguments[1]));
  const Index index = build(mesh.view(), {.threads = threads});
  const double mean_edge = mean_edge_length(index);
  std::printf("%6s %12s %12s %8s %10s\n", "edges", "counts us", "nearest us", "ratio", "found %");
  for (const double radius : numbers(arguments, 2, {5, 10})) compare(index, radius, mean_edge, threads);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"unconnected MESH THREADS [RADIUS IN MEAN EDGES...]", 2},
                                      meshhood::bench::run);
}
