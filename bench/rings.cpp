// SPDX-License-Identifier: MIT
// The vertices within k edges of every vertex, in one call, beside two searches of one vertex after the other: a
// breadth-first search over the vertices that is written for speed, and a `Searcher` by rings. On one thread, in
// alternating rounds; microseconds a vertex and, of the first two, the ratio, for the counts and for the ids.
//
//   bench_rings MESH [K...]
#include <algorithm>
#include <array>
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

/// Breadth-first search by the number of edges. Marks are numbers of queries, so nothing is cleared between them.
class PlainRings {
 public:
  explicit PlainRings(const AdjacencyView& graph) : graph_(graph), seen_(graph.size()), queue_(graph.size() + 1) {}

  std::span<const VertexId> within(VertexId v, std::size_t rings) {
    ++query_;
    queue_[0] = v;
    seen_[v] = query_;
    std::size_t end = 1;
    for (std::size_t ring = 0, begin = 0; ring < rings && begin < end; ++ring) {
      const std::size_t end_of_ring = end;
      for (; begin < end_of_ring; ++begin) {
        for (const VertexId w : graph_[queue_[begin]]) {
          // Branch-free: avoids mispredictions.
          queue_[end] = w;
          end += static_cast<std::size_t>(seen_[w] != query_);
          seen_[w] = query_;
        }
      }
    }
    return std::span(queue_).first(end);
  }

 private:
  AdjacencyView graph_;
  std::vector<std::uint32_t> seen_;
  std::vector<VertexId> queue_;
  std::uint32_t query_ = 0;
};

class Rings {
 public:
  explicit Rings(const MeshView& mesh)
      : index_(build(mesh)),
        graph_(extract_graph(index_)),
        plain_(graph_.adjacency.view()),
        edges_(index_, Metric::Rings),
        method_(SearchMethod(index_).by(Metric::Rings)) {}

  void run(std::size_t k) {
    const auto size = static_cast<VertexId>(index_.vertex_count());
    const BatchQuery query{.radius = k};
    std::array<std::size_t, 5> found{};
    std::vector<VertexId> ids;
    std::vector<VertexId> kept;
    const std::array<std::function<void()>, 5> runs{
        [&] {
          for (VertexId v = 0; v < size; ++v) found[0] += plain_.within(v, k).size();
        },
        [&] {
          for (const std::uint64_t count : counts(method_, query, {.threads = 1})) found[1] += count;
        },
        [&] {
          kept.clear();
          for (VertexId v = 0; v < size; ++v) {
            const std::span<const VertexId> some = plain_.within(v, k);
            kept.insert(kept.end(), some.begin(), some.end());
          }
          found[2] += kept.size();
        },
        [&] { found[3] += neighborhoods(method_, query, {}, {.threads = 1}).ids.size(); },
        [&] {
          for (VertexId v = 0; v < size; ++v) {
            edges_.neighborhood(v, static_cast<double>(k), ids);
            found[4] += ids.size();
          }
        }};
    std::array<double, 5> least = fastest(runs);
    const bool same = std::ranges::all_of(found, [&](std::size_t count) { return count == found[0]; });
    for (double& seconds : least) seconds *= 1e6 / size;
    std::printf("%3zu %9.1f %10.3f %10.3f %6.2f %10.3f %10.3f %6.2f %10.3f%s\n", k,
                static_cast<double>(found[0]) / kRounds / size, least[0], least[1], least[0] / least[1], least[2],
                least[3], least[2] / least[3], least[4], same ? "" : "  DIFFERENT COUNTS");
    std::fflush(stdout);
  }

 private:
  Index index_;
  GraphData graph_;
  PlainRings plain_;
  Searcher edges_;
  SearchMethod method_;
};

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments[0]);
  Rings rings(mesh.view());
  std::printf("%3s %9s %10s %10s %6s %10s %10s %6s %10s\n", "k", "vertices", "BFS count", "batch", "ratio", "BFS ids",
              "batch", "ratio", "searcher");
  for (const double k : numbers(arguments, 1, {2, 3, 5})) rings.run(static_cast<std::size_t>(k));
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_rings MESH [K...]", 1}, meshhood::bench::run);
}
