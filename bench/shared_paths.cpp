// SPDX-License-Identifier: MIT
// Whether the shortest paths from the vertices of a leaf can share work. Compares the searches of `EdgeSearcher`, one
// after the other, with one search for all vertices of a leaf (up to 32): it keeps a length for each source at each
// vertex, follows all of them over an edge together, and takes vertices in the order of the least length that has
// become shorter. Compiled for the processor of this machine, so that the loop over the sources has its vectors.
// Microseconds a source and the ratio, and how many of the lengths that are found there are for each time that the
// shared search takes a vertex: at most 32.
//
//   shared_paths MESH [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

constexpr std::size_t kSources = 32;
constexpr std::size_t kLeaves = 60;
constexpr double kUnreached = std::numeric_limits<double>::infinity();

struct alignas(64) Lengths {
  std::array<double, kSources> of;
};

/// The lengths of the shortest paths from some vertices, in one search.
class SharedSearch {
 public:
  explicit SharedSearch(const GraphView& graph) : graph_(graph.adjacency), lengths_(graph.positions.size()) {
    for (Lengths& lengths : lengths_) lengths.of.fill(kUnreached);
    for (VertexId v = 0; v < lengths_.size(); ++v) {
      for (const VertexId w : graph_[v]) edges_.push_back(distance(graph.positions, v, w));
    }
    least_.assign(lengths_.size(), kUnreached);
  }

  /// Returns how many lengths are at most `radius`.
  std::size_t run(std::span<const VertexId> sources, double radius) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      lengths_[sources[i]].of[i] = 0;
      push(sources[i], 0);
    }
    while (!queue_.empty()) {
      const auto [length, v] = queue_.top();
      queue_.pop();
      if (length != least_[v]) continue;  // it was taken since
      least_[v] = kUnreached;
      follow(v, radius);
    }
    std::size_t found = 0;
    for (const VertexId v : met_) {
      for (const double length : lengths_[v].of) found += static_cast<std::size_t>(length <= radius);
      lengths_[v].of.fill(kUnreached);
      least_[v] = kUnreached;
    }
    met_.clear();
    return found;
  }

  std::size_t taken = 0;

 private:
  using Entry = std::pair<double, VertexId>;

  void follow(VertexId v, double radius) {
    ++taken;
    const Lengths from = lengths_[v];
    std::size_t edge = graph_.offsets[v];
    for (const VertexId w : graph_[v]) {
      Lengths& to = lengths_[w];
      double shorter = kUnreached;
      for (std::size_t i = 0; i < kSources; ++i) {
        const double through = from.of[i] + edges_[edge];
        const double now = through < to.of[i] && through <= radius ? through : kUnreached;
        shorter = std::min(shorter, now);
        to.of[i] = std::min(to.of[i], now);
      }
      if (shorter < kUnreached) push(w, shorter);
      ++edge;
    }
  }

  void push(VertexId v, double length) {
    met_.push_back(v);
    if (length >= least_[v]) return;
    least_[v] = length;
    queue_.push({length, v});
  }

  AdjacencyView graph_;
  std::vector<double> edges_;
  std::vector<Lengths> lengths_;
  std::vector<double> least_;  // by vertex: of the lengths that are not followed yet
  std::vector<VertexId> met_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

int run(std::span<char*> arguments) {
  if (arguments.size() < 2) {
    std::fprintf(stderr, "usage: shared_paths MESH [RADIUS IN MEAN EDGES...]\n");
    return 2;
  }
  const MeshArgument mesh(arguments[1]);
  // In index order, so that the vertices of a leaf lie side by side for both.
  const ReorderedMesh ordered = reorder(mesh.view());
  const Index& index = ordered.index;
  const GraphData graph = extract_graph(index);
  const double mean_edge = mean_edge_length(graph.view());
  EdgeSearcher searcher(index);
  SharedSearch shared(graph.view());
  std::vector<double> edges{5, 10, 20};
  if (arguments.size() > 2) edges.clear();
  for (const char* argument : arguments.subspan(2)) edges.push_back(std::stod(argument));
  std::printf("%6s %10s %10s %10s %6s %12s\n", "edges", "vertices", "single us", "shared us", "ratio", "each time");
  const std::span<const VertexId> starts = index.leaf_starts();
  for (const double radius : edges) {
    std::array<double, 2> seconds{};
    std::array<std::size_t, 2> found{};
    std::size_t sources = 0;
    shared.taken = 0;
    for (std::size_t i = 0; i < kLeaves; ++i) {
      const std::size_t leaf = i * (starts.size() - 1) / kLeaves;
      std::vector<VertexId> of_leaf;
      for (VertexId v = starts[leaf]; v < starts[leaf + 1]; ++v) of_leaf.push_back(v);
      sources += of_leaf.size();
      double begin = measure::processor_time();
      for (const VertexId v : of_leaf) found[0] += searcher.count(v, radius * mean_edge);
      seconds[0] += measure::processor_time() - begin;
      begin = measure::processor_time();
      found[1] += shared.run(of_leaf, radius * mean_edge);
      seconds[1] += measure::processor_time() - begin;
    }
    const auto count = static_cast<double>(sources);
    std::printf("%6.4g %10.0f %10.2f %10.2f %6.2f %12.2f%s\n", radius, static_cast<double>(found[0]) / count,
                1e6 * seconds[0] / count, 1e6 * seconds[1] / count, seconds[0] / seconds[1],
                static_cast<double>(found[0]) / static_cast<double>(shared.taken),
                found[0] == found[1] ? "" : "  DIFFERENT COUNTS");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::exit_status("shared_paths",
                                      [&] { return meshhood::bench::run({argv, static_cast<std::size_t>(argc)}); });
}
