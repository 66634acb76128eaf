// SPDX-License-Identifier: MIT
// Compares eight nested radii in one pass with eight queries, on one thread, in alternating rounds. Microseconds for
// each vertex, and the ratio; beside them eight queries that only count, and the query of the largest radius alone.
//
//   nested_radii MESH [LARGEST RADIUS IN MEAN EDGES...]
#include <array>
#include <cstdio>
#include <functional>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kRadii = 8;
constexpr std::size_t kVertices = 300;

class NestedRadii {
 public:
  explicit NestedRadii(const MeshView& mesh) : index_(build(mesh)), single_(index_), nested_(index_) {
    mean_edge_ = mean_edge_length(index_);
    for (std::size_t i = 0; i < kVertices; ++i) {
      vertices_.push_back(static_cast<VertexId>(i * (index_.vertex_count() - 1) / kVertices));
    }
  }

  void run(double edges) {
    std::vector<double> radii;
    for (std::size_t i = 1; i <= kRadii; ++i) radii.push_back(edges * mean_edge_ * static_cast<double>(i) / kRadii);
    std::vector<VertexId> ids;
    std::vector<std::size_t> counts;
    std::size_t found = 0;
    std::size_t found_at_once = 0;
    const std::array<std::function<void()>, 4> runs{[&] {
                                                      for (const VertexId v : vertices_) {
                                                        for (const double radius : radii) {
                                                          single_.neighborhood(v, radius, ids);
                                                          found += ids.size();
                                                        }
                                                      }
                                                    },
                                                    [&] {
                                                      for (const VertexId v : vertices_) {
                                                        nested_.nested(v, radii, ids, counts);
                                                        for (const std::size_t count : counts) found_at_once += count;
                                                      }
                                                    },
                                                    [&] {
                                                      for (const VertexId v : vertices_) {
                                                        for (const double radius : radii)
                                                          static_cast<void>(single_.count(v, radius));
                                                      }
                                                    },
                                                    [&] {
                                                      for (const VertexId v : vertices_)
                                                        single_.neighborhood(v, radii.back(), ids);
                                                    }};
    std::array<double, 4> least = fastest(runs);
    for (double& seconds : least) seconds *= 1e6 / kVertices;
    const auto [one_by_one, at_once, counts_only, largest] = least;
    std::printf("%6.4g %10.0f %12.2f %12.2f %8.2f %12.2f %10.2f%s\n", edges,
                static_cast<double>(found) / kRounds / kVertices, one_by_one, at_once, one_by_one / at_once,
                counts_only, largest, found == found_at_once ? "" : "  DIFFERENT COUNTS");
    std::fflush(stdout);
  }

 private:
  Index index_;
  Searcher single_;
  Searcher nested_;
  double mean_edge_ = 0;
  std::vector<VertexId> vertices_;
};

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  NestedRadii nested(mesh.view());
  std::printf("%6s %10s %12s %12s %8s %12s %10s\n", "edges", "vertices", "8 queries us", "nested us", "ratio",
              "8 counts us", "largest us");
  for (const double radius : numbers(arguments, 1, {20, 65})) nested.run(radius);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"nested_radii MESH [LARGEST RADIUS IN MEAN EDGES...]", 1},
                                      meshhood::bench::run);
}
