// SPDX-License-Identifier: MIT
// The exact index against breadth-first search on graphs that are unlike a surface: stars, hubs, random graphs, and all
// families of the tests. Prints the ratio of the two times; above 1 the index is faster. Usage: odd_graphs [VERTICES]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "support/families.h"
#include "support/oracle.h"

namespace meshhood::bench {
namespace {

using test::Random;
using test::TestMesh;

constexpr std::size_t kQueries = 40;
constexpr int kRounds = 5;
constexpr std::array kRadii{0.3, 1.0, 2.0, 5.0, 20.0, 65.0};  // in mean edges

void add_random_vertices(TestMesh& mesh, Random& random, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) mesh.add_vertex(random.uniform(), random.uniform(), random.uniform());
}

/// Every vertex is joined to one of `hubs` vertices.
TestMesh make_hubs(Random& random, std::size_t vertices, std::size_t hubs) {
  TestMesh mesh;
  add_random_vertices(mesh, random, vertices);
  for (std::size_t v = hubs; v < vertices; ++v) {
    mesh.add_face({static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(random.below(hubs))});
  }
  return mesh.finish(true);
}

/// `degree / 2` edges a vertex, to vertices anywhere.
TestMesh make_random_graph(Random& random, std::size_t vertices, std::size_t degree) {
  TestMesh mesh;
  add_random_vertices(mesh, random, vertices);
  for (std::size_t i = 0; i < vertices * degree / 2; ++i) {
    mesh.add_face(
        {static_cast<std::uint32_t>(random.below(vertices)), static_cast<std::uint32_t>(random.below(vertices))});
  }
  return mesh.finish(true);
}

/// Processor time, which depends less on other programs.
double seconds_of(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begin = now();
  work();
  return now() - begin;
}

double mean_edge_of(const MeshView& mesh, const AdjacencyView& graph) {
  double sum = 0;
  for (VertexId v = 0; v < graph.size(); ++v) {
    for (const VertexId w : graph[v]) sum += distance(mesh.positions, v, w);
  }
  return graph.neighbors.empty() ? 1 : sum / static_cast<double>(graph.neighbors.size());
}

/// The two methods in turn on the same queries, the best of several rounds each.
double time_ratio(Searcher& exact, ReferenceSearcher& bfs, const std::vector<VertexId>& vertices, double radius) {
  std::vector<VertexId> out;
  double best_exact = std::numeric_limits<double>::infinity();
  double best_bfs = best_exact;
  for (int round = 0; round < kRounds; ++round) {
    best_exact = std::min(best_exact, seconds_of([&] {
                            for (const VertexId v : vertices) exact.neighborhood(v, radius, out);
                          }));
    best_bfs = std::min(best_bfs, seconds_of([&] {
                          for (const VertexId v : vertices) bfs.neighborhood(v, radius, out);
                        }));
  }
  return best_bfs / best_exact;
}

double race(const std::string& name, const TestMesh& mesh) {
  if (mesh.size() == 0) return 1;
  const MeshView view = mesh.view();
  const Index index = build(view);
  Searcher exact(index);
  ReferenceSearcher bfs(view);
  const double edge = mean_edge_of(view, bfs.adjacency());
  Random random(1);
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < kQueries; ++i) vertices.push_back(static_cast<VertexId>(random.below(mesh.size())));
  std::printf("%-20s %7zu", name.c_str(), mesh.size());
  double least = std::numeric_limits<double>::infinity();
  for (const double radius : kRadii) {
    const double ratio = time_ratio(exact, bfs, vertices, radius * edge);
    least = std::min(least, ratio);
    std::printf(" %7.2f", ratio);
  }
  std::printf("%s\n", least < 0.9 ? "  below 0.9" : "");
  return least;
}

void run(std::size_t vertices) {
  std::printf("%-20s %7s", "graph", "#V");
  for (const double radius : kRadii) std::printf(" %6.3ge", radius);
  std::printf("\n");
  Random random(5);
  double least = race("1 hub", make_hubs(random, vertices, 1));
  least = std::min(least, race("200 hubs", make_hubs(random, vertices, 200)));
  for (const std::size_t degree : {2U, 6U, 20U}) {
    least =
        std::min(least, race("random, degree " + std::to_string(degree), make_random_graph(random, vertices, degree)));
  }
  for (const test::Family& family : test::families()) {
    least = std::min(least, race(std::string(family.name), test::make_mesh(family, 1, vertices)));
  }
  std::printf("least ratio: %.2f\n", least);
}

}  // namespace
}  // namespace meshhood::bench

int main(int arguments, char** values) {
  meshhood::bench::run(arguments > 1 ? std::strtoul(values[1], nullptr, 10) : 20'000);
  return 0;
}
