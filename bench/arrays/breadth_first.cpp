// SPDX-License-Identifier: MIT
// The reference search for all vertices of a mesh in memory, its adjacency included. Answers each line "QUESTION
// RADIUS" of the input by a line: the seconds to make the adjacency, the seconds to answer, and the number of vertices
// found. QUESTION is counts, ids (all of them in one array) or mean (of a signal).
//
//   breadth_first MESH THREADS
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

class BreadthFirst {
 public:
  BreadthFirst(const MeshView& mesh, unsigned threads)
      : mesh_(mesh), threads_(threads), signal_(mesh.positions.size()) {
    std::iota(signal_.begin(), signal_.end(), 0.0);
  }

  void answer(const std::string& question, double radius) const {
    const auto begin = Clock::now();
    const Adjacency graph = adjacency(mesh_);
    const double built = seconds_since(begin);
    const std::uint64_t found = answer(question, {mesh_.positions, graph.view()}, radius);
    std::printf("%.9f %.9f %llu\n", built, seconds_since(begin) - built, static_cast<unsigned long long>(found));
    std::fflush(stdout);
  }

 private:
  [[nodiscard]] std::uint64_t answer(const std::string& question, const GraphView& graph, double radius) const {
    const SearchMethod method = SearchMethod::breadth_first(graph);
    if (question == "counts") {
      const auto sizes = counts(method, {.radius = radius}, {.threads = threads_});
      return std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    }
    if (question == "ids") return neighborhoods(method, {.radius = radius}, {}, {.threads = threads_}).ids.size();
    if (question == "mean") return means(graph, radius);
    throw std::invalid_argument("unknown question: " + question);
  }

  /// Each thread takes the next few vertices until none is left.
  [[nodiscard]] std::uint64_t means(const GraphView& graph, double radius) const {
    constexpr std::size_t kChunk = 256;
    const std::size_t vertices = signal_.size();
    std::vector<double> result(vertices);
    std::atomic<std::size_t> next{0};
    std::atomic<std::uint64_t> found{0};
    const auto work = [&] {
      ReferenceSearcher searcher(graph);
      std::vector<VertexId> ids;
      for (std::size_t begin = next.fetch_add(kChunk); begin < vertices; begin = next.fetch_add(kChunk)) {
        std::uint64_t sizes = 0;
        for (std::size_t v = begin; v < std::min(begin + kChunk, vertices); ++v) {
          double sum = 0;
          searcher.neighborhood(static_cast<VertexId>(v), radius, ids);
          for (const VertexId id : ids) sum += signal_[id];
          result[v] = sum / static_cast<double>(ids.size());
          sizes += ids.size();
        }
        found += sizes;
      }
    };
    std::vector<std::jthread> helpers;
    helpers.reserve(threads_);
    for (unsigned thread = 1; thread < threads_; ++thread) helpers.emplace_back(work);
    work();
    helpers.clear();
    return found;
  }

  MeshView mesh_;
  unsigned threads_;
  std::vector<double> signal_;
};

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  using namespace meshhood::bench;
  return run_program(argc, argv, {"breadth_first MESH THREADS < LINES", 2, 2}, [](const Arguments& arguments) {
    const MeshArgument mesh(arguments[0]);
    const BreadthFirst search(mesh.view(), static_cast<unsigned>(std::stoul(arguments[1])));
    std::string question;
    double radius = 0;
    while (std::cin >> question >> radius) search.answer(question, radius);
    return 0;
  });
}
