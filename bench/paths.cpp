// SPDX-License-Identifier: MIT
// Paths along the edges from every vertex, in one call, beside one `Searcher` that answers one vertex after the
// other: counts, ids with lengths, and a smoothed map. On one thread, in alternating rounds; microseconds a vertex, and
// how many times as fast the call is. Then the same along the surface, if the mesh has faces.
//
//   bench_paths MESH [RADIUS IN MEAN EDGES...]
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

const Run kOneThread{.threads = 1};

class Paths {
 public:
  Paths(const Index& index, double mean_edge)
      : index_(index),
        mean_edge_(mean_edge),
        edges_(index_, Metric::Path),
        method_(SearchMethod(index_).by(Metric::Path)),
        map_(index_.vertex_count()) {
    for (std::size_t v = 0; v < map_.size(); ++v) map_[v] = static_cast<double>(v % 97);
  }

  void run(double radius_in_edges) {
    const double radius = radius_in_edges * mean_edge_;
    const BatchQuery query{.radius = radius};
    const auto size = static_cast<VertexId>(index_.vertex_count());
    std::array<double, 6> found{};
    const std::array<std::function<void()>, 6> runs{
        [&] {
          for (VertexId v = 0; v < size; ++v) found[0] += static_cast<double>(edges_.count(v, radius));
        },
        [&] {
          for (const std::uint64_t count : counts(method_, query, kOneThread)) found[1] += static_cast<double>(count);
        },
        [&] {
          kept_.clear();
          kept_lengths_.clear();
          for (VertexId v = 0; v < size; ++v) {
            edges_.neighborhood(v, radius, ids_, lengths_);
            kept_.insert(kept_.end(), ids_.begin(), ids_.end());
            kept_lengths_.insert(kept_lengths_.end(), lengths_.begin(), lengths_.end());
          }
          found[2] += static_cast<double>(kept_.size());
        },
        [&] {
          // Into the same memory, as the ids of one vertex after the other.
          const auto allocate = [&](std::size_t count) {
            kept_.resize(count);
            kept_lengths_.resize(count);
            return BatchMemory{kept_, kept_lengths_};
          };
          found[3] +=
              static_cast<double>(neighborhoods(method_, query, allocate, {.distances = true}, kOneThread).back());
        },
        [&] {
          for (VertexId v = 0; v < size; ++v) found[4] += smoothed(v, radius);
        },
        [&] {
          const AggregateQuery smooth{.radius = radius, .metric = Metric::Path, .kernel = SmoothingKernel::Biweight};
          for (const double mean : aggregate(index_, {std::span<const double>(map_)}, smooth, kOneThread))
            found[5] += mean;
        }};
    const std::array<double, 6> least = fastest(runs);
    std::printf("%6.4g %9.1f", radius_in_edges, found[0] / kRounds / size);
    for (std::size_t i = 0; i < runs.size(); i += 2) {
      std::printf(" %10.3f %10.3f %6.2f", 1e6 * least[i] / size, 1e6 * least[i + 1] / size, least[i] / least[i + 1]);
    }
    const bool same = found[0] == found[1] && found[2] == found[3] && std::abs(found[4] - found[5]) < 1e-9 * found[4];
    std::printf("%s\n", same ? "" : "  DIFFERENT RESULTS");
    std::fflush(stdout);
  }

 private:
  double smoothed(VertexId v, double radius) {
    edges_.neighborhood(v, radius, ids_, lengths_);
    double sum = 0;
    double weights = 0;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const double t = lengths_[i] / radius;
      const double weight = (1 - t * t) * (1 - t * t);
      sum += weight * map_[ids_[i]];
      weights += weight;
    }
    return sum / weights;
  }

  const Index& index_;
  double mean_edge_;
  Searcher edges_;
  SearchMethod method_;
  std::vector<double> map_;
  std::vector<VertexId> ids_;
  std::vector<double> lengths_;
  std::vector<VertexId> kept_;
  std::vector<double> kept_lengths_;
};

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  const Index index = build(mesh.view());
  const double mean_edge = mean_edge_length(index);
  const auto compare = [&](const char* along, const Index& searched) {
    std::printf("along %s\n%6s %9s", along, "edges", "vertices");
    for (const char* what : {"count", "ids", "smooth"}) std::printf(" %10s %10s %6s", what, "batch", "ratio");
    std::printf("\n");
    Paths paths(searched, mean_edge);
    for (const double radius : numbers(arguments, 1, {5, 10, 20})) paths.run(radius);
  };
  compare("edges", index);
  if (mesh.view().faces.size() > 0) compare("the surface", surface_paths(Surface(index, mesh.view().faces)));
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_paths MESH [RADIUS IN MEAN EDGES...]", 1},
                                      meshhood::bench::run);
}
