// SPDX-License-Identifier: MIT
// Compares `invariants` and `gaps` for all vertices with the plain search of the tests, in double, for a sample of
// them. Microseconds of the first thread for each vertex, so that the ratio is of one thread only if THREADS is 1, and
// the largest deviation in units of pi r^2 and of the ball.
//
//   bench_patches MESH THREADS [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"
#include "support/patch_reference.h"

namespace meshhood::bench {
namespace {

using Reference = test::PatchReference<double>;

constexpr std::size_t kSample = 400;

/// Microseconds for each of `rows`.
template <class F>
double time_of(std::size_t rows, F&& f) {
  const double start = measure::processor_time();
  f();
  return 1e6 * (measure::processor_time() - start) / static_cast<double>(rows);
}

/// Of a mesh of triangles.
Reference make_reference(const MeshView& mesh) {
  std::vector<double> positions;
  mesh.positions.visit([&](const auto& xyz) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) positions.push_back(static_cast<double>(xyz(v, axis)));
    }
  });
  std::vector<Reference::Triangle> triangles;
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    if (corners.size() == 3) triangles.push_back({corners[0], corners[1], corners[2]});
  });
  std::vector<Reference::Triangle> owners(triangles.size());
  return {positions, std::move(triangles), std::move(owners)};
}

/// Microseconds a vertex.
struct Times {
  double plain;
  double measured;
};

Times compare(const Surface& surface, const Reference& reference, double edges, double radius, unsigned threads) {
  const std::size_t rows = surface.vertex_count();
  std::vector<VertexId> sample;
  for (std::size_t i = 0; i < kSample; ++i) sample.push_back(static_cast<VertexId>(i * rows / kSample));
  std::vector<Reference::Answer> plain;
  const double plainly = time_of(sample.size(), [&] {
    for (const VertexId v : sample) plain.push_back(reference.measure(v, radius));
  });
  const BatchQuery query{.radius = radius};
  const Run options{.threads = threads};
  Invariants found;
  const double measuring = time_of(rows, [&] { found = invariants(surface, query, options); });
  std::vector<SurfacePoint> nearest;
  const double searching = time_of(rows, [&] { nearest = gaps(surface, query, options); });
  double area = 0;
  double volume = 0;
  double faces = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    faces += static_cast<double>(plain[i].faces.size()) / static_cast<double>(sample.size());
    area = std::max(area, std::abs(found.area[sample[i]] - plain[i].area));
    if (!std::isnan(plain[i].volume)) volume = std::max(volume, std::abs(found.volume[sample[i]] - plain[i].volume));
  }
  const double disc = std::numbers::pi * radius * radius;
  std::printf("%6.4g %8.0f %10.2f %10.3f %8.1f %10.3f %10.1e %10.1e\n", edges, faces, plainly, measuring,
              plainly / measuring, searching, area / disc, volume / (disc * radius * 4 / 3));
  std::fflush(stdout);
  return {plainly, measuring};
}

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const auto threads = static_cast<unsigned>(std::stoul(arguments[1]));
  const Index index = build(mesh.view(), {.threads = threads});
  const double mean_edge = mean_edge_length(index);
  const double start = measure::processor_time();
  const Surface surface(index, mesh.view().faces);
  std::printf("built in %.2f s, %.0f bytes a face\n", measure::processor_time() - start,
              static_cast<double>(surface.bytes()) / static_cast<double>(surface.face_count()));
  const Reference reference = make_reference(mesh.view());
  std::printf("%6s %8s %10s %10s %8s %10s %10s %10s\n", "edges", "faces", "plain us", "us", "ratio", "gap us", "area",
              "volume");
  Times all{0, 0};
  for (const double count : numbers(arguments, 2, {1, 3, 5, 10, 16})) {
    const auto [plain, measured] = compare(surface, reference, count, count * mean_edge, threads);
    all.plain += plain;
    all.measured += measured;
  }
  std::printf("%6s %8s %10.2f %10.3f %8.1f\n", "all", "", all.plain, all.measured, all.plain / all.measured);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_patches MESH THREADS [RADIUS IN MEAN EDGES...]", 2},
                                      meshhood::bench::run);
}
