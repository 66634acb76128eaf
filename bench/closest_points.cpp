// SPDX-License-Identifier: MIT
// The time of closest points, for points near the surface and in its box: one by one, and as a batch. One thread.
//
//   closest_points MESH
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

constexpr int kRounds = 4;
constexpr std::size_t kPoints = 40000;
constexpr std::size_t kSingle = 4000;

/// The time of the fastest round, in microseconds a point.
template <class F>
double time_of(std::size_t points, F&& f) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    f();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return 1e6 * least / static_cast<double>(points);
}

/// Corners of random faces, moved by up to `distance` along each axis; in the box if it is infinite.
std::vector<SpacePoint> random_points(const MeshView& mesh, double distance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto positions = mesh.positions.visit([](const auto& xyz) {
    std::vector<SpacePoint> all(xyz.size());
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) all[v][axis] = static_cast<double>(xyz(v, axis));
    }
    return all;
  });
  SpacePoint low = positions.front();
  SpacePoint high = positions.front();
  for (const SpacePoint& p : positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  std::vector<SpacePoint> points(kPoints);
  for (SpacePoint& p : points) {
    const SpacePoint& vertex = positions[random() % positions.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis] = distance < std::numeric_limits<double>::infinity()
                    ? vertex[axis] + distance * unit(random)
                    : low[axis] + (high[axis] - low[axis]) * (unit(random) + 1) / 2;
    }
  }
  return points;
}

int run(std::span<char*> arguments) {
  if (arguments.size() != 2) {
    std::fprintf(stderr, "usage: closest_points MESH\n");
    return 2;
  }
  const MeshArgument mesh(arguments[1]);
  const Index index = build(mesh.view());
  const double mean_edge = mean_edge_length(index);
  const Surface surface(index, mesh.view().faces);
  const double making =
      1e-3 * time_of(1, [&] { static_cast<void>(Surface(index, mesh.view().faces).closest_point({})); });
  std::printf("made in %.1f ms\n", making);
  std::printf("%8s %10s %10s\n", "edges", "single us", "batch us");
  for (const double edges : {0.1, 1.0, 10.0, std::numeric_limits<double>::infinity()}) {
    const std::vector<SpacePoint> points = random_points(mesh.view(), edges * mean_edge);
    const double single = time_of(kSingle, [&] {
      for (const SpacePoint& p : std::span(points).first(kSingle)) static_cast<void>(surface.closest_point(p));
    });
    const double batch =
        time_of(points.size(), [&] { static_cast<void>(surface.closest_points(points, {.threads = 1})); });
    std::printf("%8.4g %10.2f %10.2f\n", edges, single, batch);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::exit_status("closest_points",
                                      [&] { return meshhood::bench::run({argv, static_cast<std::size_t>(argc)}); });
}
