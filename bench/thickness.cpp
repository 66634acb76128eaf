// SPDX-License-Identifier: MIT
// The time of first hits, of rays between random points of the mesh's box, and of thickness by both methods, of all
// vertices or of some spread evenly. Microseconds of one thread: as many are the seconds for a million rows.
//
//   bench_thickness MESH [VERTICES]
#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"
#include "random_points.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kRays = 40000;
const Run kOneThread{.threads = 1};

void measure_rays(const Surface& surface, const MeshView& mesh) {
  const std::vector<SpacePoint> ends = random_points(mesh, 2 * kRays, std::numeric_limits<double>::infinity());
  const auto origins = std::span(ends).first(kRays);
  std::vector<SpacePoint> directions(ends.begin() + kRays, ends.end());
  for (std::size_t i = 0; i < kRays; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) directions[i][axis] -= origins[i][axis];
  }
  const double single = microseconds(kRays, [&] {
    for (std::size_t i = 0; i < kRays; ++i) static_cast<void>(surface.first_hit(origins[i], directions[i]));
  });
  const double batch =
      microseconds(kRays, [&] { static_cast<void>(surface.first_hits(origins, directions, kOneThread)); });
  std::printf("first hit %.2f, in a batch %.2f\n", single, batch);
}

void measure_thickness(const Surface& surface, std::size_t count) {
  std::vector<VertexId> vertices(count);
  for (std::size_t i = 0; i < count; ++i) {
    vertices[i] = static_cast<VertexId>(i * surface.vertex_count() / count);
  }
  for (const auto& [name, method] : {std::pair("ray", ThicknessMethod::Ray), {"sphere", ThicknessMethod::Sphere}}) {
    static_cast<void>(thickness(surface, std::span(vertices).first(1), method));  // makes what is kept
    const double start = measure::processor_time();
    const std::vector<double> found = thickness(surface, vertices, method, kOneThread);
    const double each = 1e6 * (measure::processor_time() - start) / static_cast<double>(count);
    std::printf("thickness by %s %.2f, of %zu vertices\n", name, each, count);
    std::fflush(stdout);
  }
}

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const Index index = build(mesh.view());
  const std::size_t all = mesh.view().positions.size();
  const Surface surface(index, mesh.view().faces);
  measure_rays(surface, mesh.view());
  measure_thickness(surface, arguments.size() == 2 ? std::min<std::size_t>(std::stoul(arguments[1]), all) : all);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_thickness MESH [VERTICES]", 1, 2}, meshhood::bench::run);
}
