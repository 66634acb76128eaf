// SPDX-License-Identifier: MIT
// Libraries in C++: our breadth-first search, nanoflann's ball, and curvature by our search and by breadth-first
// search. bench/peers/native.py runs it.
//
//   native_peers bfs|nanoflann|curvature|curvature-bfs MESH THREADS
//
// The first line of output is the build time in seconds. Each line of input is `RADIUS QUERIES_FILE [ANSWERS_FILE]`:
// the program answers the queries (32-bit vertices) and prints the time in seconds. All answers are kept in memory
// during the measurement. If there is an ANSWERS_FILE, it receives for each query the number of ids and the ids, all of
// 32 bits; for curvatures, two floats in place of the ids.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nanoflann.hpp>

#include "meshhood/meshhood.h"

#include "mesh_argument.h"
#include "peers/quadric_fit.h"
#include "point_cloud.h"
#include "program.h"

namespace meshhood::bench {
namespace {

using Answer = std::vector<VertexId>;
/// Answers a query on the thread with this number.
using Search = std::function<void(unsigned thread, VertexId v, double radius, Answer& out)>;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

Search breadth_first(const MeshView& mesh, unsigned threads) {
  auto graph = std::make_shared<Adjacency>(adjacency(mesh));
  auto searchers = std::make_shared<std::vector<ReferenceSearcher>>();
  for (unsigned i = 0; i < threads; ++i) searchers->emplace_back(GraphView{mesh.positions, graph->view()});
  return [graph, searchers](unsigned thread, VertexId v, double radius, Answer& out) {
    (*searchers)[thread].neighborhood(v, radius, out);
  };
}

Search kd_tree(const MeshView& mesh) {
  auto cloud = std::make_shared<PointCloud>(mesh.positions);
  auto tree = std::make_shared<KdTree>(3, *cloud);
  return [cloud, tree](unsigned /*thread*/, VertexId v, double radius, Answer& out) {
    thread_local std::vector<std::pair<VertexId, float>> found;
    const auto squared = static_cast<float>(radius * radius);
    tree->radiusSearch(&cloud->xyz[3 * std::size_t{v}], squared, found, nanoflann::SearchParams(0, 0, false));
    out.clear();
    for (const auto& item : found) out.push_back(item.first);
  };
}

Search exact(const MeshView& mesh, unsigned threads) {
  auto index = std::make_shared<Index>(build(mesh, {.threads = threads}));
  auto searchers = std::make_shared<std::vector<Searcher>>();
  for (unsigned i = 0; i < threads; ++i) searchers->emplace_back(*index);
  return [index, searchers](unsigned thread, VertexId v, double radius, Answer& out) {
    (*searchers)[thread].neighborhood(v, radius, out);
  };
}

/// The curvatures of a quadric fitted to the vertices that `search` finds, in place of the ids.
Search curvature(const MeshView& mesh, const Search& search) {
  auto fit = std::make_shared<QuadricFit>(mesh);
  return [fit, search](unsigned thread, VertexId v, double radius, Answer& out) {
    search(thread, v, radius, out);
    const std::array<double, 2> found = fit->curvatures(v, out);
    out.resize(found.size());
    std::transform(found.begin(), found.end(), out.begin(),
                   [](double value) { return std::bit_cast<VertexId>(static_cast<float>(value)); });
  };
}

Search make(const std::string& kind, const MeshView& mesh, unsigned threads) {
  if (kind == "bfs") return breadth_first(mesh, threads);
  if (kind == "nanoflann") return kd_tree(mesh);
  if (kind == "curvature") return curvature(mesh, exact(mesh, threads));
  if (kind == "curvature-bfs") return curvature(mesh, breadth_first(mesh, threads));
  throw std::invalid_argument("unknown library: " + kind);
}

std::vector<VertexId> read_queries(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<VertexId> queries(static_cast<std::size_t>(file.tellg()) / sizeof(VertexId));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(queries.data()), static_cast<std::streamsize>(queries.size() * sizeof(VertexId)));
  return queries;
}

void write_answers(const std::string& path, const std::vector<Answer>& answers) {
  std::ofstream file(path, std::ios::binary);
  for (const Answer& answer : answers) {
    const auto count = static_cast<std::uint32_t>(answer.size());
    file.write(reinterpret_cast<const char*>(&count), sizeof count);
    file.write(reinterpret_cast<const char*>(answer.data()),
               static_cast<std::streamsize>(answer.size() * sizeof(VertexId)));
  }
}

/// Each thread takes the next few queries until none is left.
void answer_all(const Search& search, const std::vector<VertexId>& queries, double radius, unsigned threads,
                std::vector<Answer>& answers) {
  constexpr std::size_t kChunk = 16;
  std::atomic<std::size_t> next{0};
  const auto work = [&](unsigned thread) {
    for (std::size_t begin = next.fetch_add(kChunk); begin < queries.size(); begin = next.fetch_add(kChunk)) {
      const std::size_t end = std::min(begin + kChunk, queries.size());
      for (std::size_t i = begin; i < end; ++i) search(thread, queries[i], radius, answers[i]);
    }
  };
  std::vector<std::jthread> helpers;
  helpers.reserve(threads);
  for (unsigned thread = 1; thread < threads; ++thread) helpers.emplace_back(work, thread);
  work(0);
}

void serve(const Search& search, unsigned threads) {
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    double radius = 0;
    std::string from;
    std::string to;
    words >> radius >> from >> to;
    const std::vector<VertexId> queries = read_queries(from);
    std::vector<Answer> answers(queries.size());
    const auto begin = Clock::now();
    answer_all(search, queries, radius, threads, answers);
    const double seconds = seconds_since(begin);
    if (!to.empty()) write_answers(to, answers);
    std::cout << seconds << '\n' << std::flush;
  }
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  using namespace meshhood::bench;
  return run_program(argc, argv, {"native SEARCH MESH THREADS", 3, 3}, [](const Arguments& arguments) {
    const MeshArgument mesh(arguments[1]);
    const auto threads = static_cast<unsigned>(std::stoul(arguments[2]));
    const auto begin = Clock::now();
    const Search search = make(arguments[0], mesh.view(), threads);
    std::cout << seconds_since(begin) << '\n' << std::flush;
    serve(search, threads);
    return 0;
  });
}
