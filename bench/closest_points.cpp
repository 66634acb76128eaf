// SPDX-License-Identifier: MIT
// The time of closest points, for points near the surface and in its box: one by one, and as a batch. One thread.
//
//   bench_closest_points MESH
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"
#include "random_points.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kPoints = 40000;
constexpr std::size_t kSingle = 4000;

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const Index index = build(mesh.view());
  const double mean_edge = mean_edge_length(index);
  const Surface surface(index, mesh.view().faces);
  const double making =
      1e-3 * microseconds(1, [&] { static_cast<void>(Surface(index, mesh.view().faces).closest_point({})); });
  std::printf("made in %.1f ms\n", making);
  std::printf("%8s %10s %10s\n", "edges", "single us", "batch us");
  for (const double edges : {0.1, 1.0, 10.0, std::numeric_limits<double>::infinity()}) {
    const std::vector<SpacePoint> points = random_points(mesh.view(), kPoints, edges * mean_edge);
    const double single = microseconds(kSingle, [&] {
      for (const SpacePoint& p : std::span(points).first(kSingle)) static_cast<void>(surface.closest_point(p));
    });
    const double batch =
        microseconds(points.size(), [&] { static_cast<void>(surface.closest_points(points, {.threads = 1})); });
    std::printf("%8.4g %10.2f %10.2f\n", edges, single, batch);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_closest_points MESH", 1, 1}, meshhood::bench::run);
}
