// SPDX-License-Identifier: MIT
// The batch of all vertices with walls and with ignored vertices, beside that without, on one thread, in alternating
// rounds. For each mask and radius: microseconds a vertex without a filter, and the time with it as a multiple, for the
// counts and for the ids. *Region* is the neighborhood of one vertex that has about a tenth of the mesh, *seam* its
// vertices within one edge of the plane through the middle, *scattered* one vertex in a thousand.
//
//   bench_walls MESH [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"
#include "rounds.h"

namespace meshhood::bench {
namespace {

using Mask = std::vector<std::uint8_t>;

struct NamedMask {
  const char* name;
  Mask mask;
};

class Walls {
 public:
  explicit Walls(const MeshView& mesh) : index_(build(mesh)), size_(index_.vertex_count()) {
    mean_edge_ = mean_edge_length(index_);
    masks_ = {{"region", region()}, {"seam", seam(mesh.positions)}, {"scattered", scattered()}};
  }

  void run(double edges) {
    for (const NamedMask& named : masks_) {
      compare(edges, named.name, "walls", {.walls = named.mask});
      compare(edges, named.name, "ignored", {.ignored = named.mask});
    }
  }

 private:
  [[nodiscard]] Mask region() const {
    Searcher searcher(index_);
    std::vector<VertexId> ids;
    for (double radius = mean_edge_; 10 * ids.size() < size_ && radius < 1e4 * mean_edge_; radius *= 1.1) {
      searcher.neighborhood(0, radius, ids);
    }
    Mask mask(size_);
    for (const VertexId v : ids) mask[v] = 1;
    return mask;
  }

  [[nodiscard]] Mask seam(const PositionsView& positions) const {
    std::vector<double> x(size_);
    positions.visit([&](const auto& xyz) {
      for (std::size_t v = 0; v < size_; ++v) x[v] = static_cast<double>(xyz(v, 0));
    });
    std::vector<double> sorted = x;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(size_ / 2), sorted.end());
    const double middle = sorted[size_ / 2];
    Mask mask(size_);
    for (std::size_t v = 0; v < size_; ++v) mask[v] = std::abs(x[v] - middle) <= mean_edge_ ? 1 : 0;
    return mask;
  }

  [[nodiscard]] Mask scattered() const {
    Mask mask(size_);
    for (std::size_t v = 500; v < size_; v += 1000) mask[v] = 1;
    return mask;
  }

  void compare(double edges, const char* name, const char* kind, const Masks& masks) {
    const BatchQuery query{.radius = edges * mean_edge_};
    const Index searched = masked(index_, masks);
    std::size_t found = 0;
    const auto count = [&](const Index& index) { return [&] { found = counts(index, query).size(); }; };
    const auto list = [&](const Index& index) {
      return [&] { for_each_neighborhood(index, query, [&](const BatchRow& row) { found += row.ids.size(); }); };
    };
    const auto [count_plain, count_with, list_plain, list_with] =
        fastest<4>({count(index_), count(searched), list(index_), list(searched)});
    const double to_us = 1e6 / static_cast<double>(size_);
    std::printf("%6.4g %-10s %-8s %10.3f %8.2f %10.3f %8.2f\n", edges, name, kind, to_us * count_plain,
                count_with / count_plain, to_us * list_plain, list_with / list_plain);
    std::fflush(stdout);
  }

  Index index_;
  std::size_t size_;
  double mean_edge_ = 0;
  std::vector<NamedMask> masks_;
};

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  Walls walls(mesh.view());
  std::printf("%6s %-10s %-8s %10s %8s %10s %8s\n", "edges", "mask", "as", "counts us", "ratio", "ids us", "ratio");
  for (const double radius : numbers(arguments, 1, {5, 10, 20})) walls.run(radius);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_walls MESH [RADIUS IN MEAN EDGES...]", 1},
                                      meshhood::bench::run);
}
