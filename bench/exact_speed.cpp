// SPDX-License-Identifier: MIT
// The exact engine beside the best breadth-first search, on the mesh as it is and in index order.
// Usage: exact_speed MESH [RADIUS...]; radii in mean edges. MESH is a file, or a shape as "scroll:1000000".
//
// Every method is timed in turn on small blocks of queries, and the median block counts: what else the machine does
// hits all alike. Cold: random vertices, fresh ones for each method. Warm: consecutive vertices in index order, with
// other memory touched before each block. Times are of the processor, not of the wall.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "meshhood/meshhood.h"

#include "exact_mesh.h"
#include "point_cloud.h"
#include "reordered.h"

namespace meshhood::bench {
namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

enum Method : std::size_t { BfsGiven, BfsReordered, Ids, Count, Ranges, Methods };

class Bench {
 public:
  explicit Bench(const MeshView& mesh)
      : adjacency_(adjacency(mesh)),
        graph_{mesh.positions, adjacency_.view()},
        index_(build(mesh)),
        reordered_(graph_, index_.permutation()),
        given_(graph_),
        in_order_(reordered_.view()),
        searcher_(index_),
        mean_edge_(mean_edge_length(graph_)),
        other_memory_(std::size_t{1} << 20) {}

  void row(double edges, bool warm) {
    constexpr std::size_t kBlocks = 15;
    std::array<std::vector<double>, Methods> times;
    found_ = 0;
    const std::size_t queries = queries_of_a_block(edges * mean_edge_);
    for (std::size_t block = 0; block < kBlocks; ++block) {
      std::vector<VertexId> asked = pick(queries, warm);
      for (std::size_t i = 0; i < Methods; ++i) {
        const auto method = static_cast<Method>((i + block) % Methods);
        if (!warm) asked = pick(queries, false);
        times[method].push_back(time(method, asked, edges * mean_edge_));
        for (std::size_t k = 0; k < other_memory_.size(); k += 16) ++other_memory_[k];
      }
    }
    std::array<double, Methods> typical{};
    std::transform(times.begin(), times.end(), typical.begin(), median);
    const double best = std::min(typical[BfsGiven], typical[BfsReordered]);
    std::printf("| %s | %g | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f / %.1f / %.1f |\n", warm ? "warm" : "cold",
                edges, found_ / (kBlocks * queries), typical[BfsGiven], typical[BfsReordered], typical[Ids],
                typical[Count], typical[Ranges], best / typical[Ids], best / typical[Ranges], best / typical[Count]);
    std::fflush(stdout);
  }

  /// A batch over a run of vertices as the caller numbers them, in one thread, beside the better search over as many of
  /// them as there is time for, in blocks taken in turn.
  void batch(double edges) {
    constexpr std::size_t kBlocks = 15;
    constexpr std::size_t kSearched = 20;
    const double radius = edges * mean_edge_;
    const std::size_t run = std::min(8 * queries_of_a_block(radius), index_.vertex_count());
    std::array<std::vector<double>, 4> times;
    for (std::size_t block = 0; block < kBlocks; ++block) {
      std::vector<VertexId> asked(run);
      std::iota(asked.begin(), asked.end(), static_cast<VertexId>(random_() % (index_.vertex_count() - run + 1)));
      const std::vector<VertexId> searched(asked.begin(),
                                           asked.begin() + static_cast<std::ptrdiff_t>(std::min(kSearched, run)));
      times[0].push_back(time(BfsGiven, searched, radius));
      times[1].push_back(time(BfsReordered, searched, radius));
      const BatchQuery query{.vertices = asked, .radius = radius};
      const double begin = processor_seconds();
      for_each_neighborhood(index_, query, [&](const BatchRow& row) { sink_ += row.ids.size(); });
      const double between = processor_seconds();
      for (const std::uint64_t count : counts(index_, query)) sink_ += count;
      const double end = processor_seconds();
      times[2].push_back(1e6 * (between - begin) / static_cast<double>(run));
      times[3].push_back(1e6 * (end - between) / static_cast<double>(run));
    }
    const double best = std::min(median(times[0]), median(times[1]));
    const double ids = median(times[2]);
    const double count = median(times[3]);
    std::printf("\nbatch at %g edges, us a row: BFS %.2f, ids %.2f (x %.1f), counts %.2f (x %.1f)\n", edges, best, ids,
                best / ids, count, best / count);
  }

  [[nodiscard]] const Index& index() const { return index_; }

 private:
  /// Fewer where the answers are large, so that a row takes seconds.
  std::size_t queries_of_a_block(double radius) {
    constexpr std::size_t kProbes = 16;
    constexpr std::size_t kVertices = 1'000'000;
    std::size_t found = 0;
    for (const VertexId v : pick(kProbes, false)) found += searcher_.count(v, radius);
    return std::clamp<std::size_t>(kVertices * kProbes / found, 10, 300);
  }

  static double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  std::vector<VertexId> pick(std::size_t queries, bool warm) {
    const std::size_t vertices = index_.vertex_count();
    const std::size_t first = random_() % vertices;
    std::vector<VertexId> result;
    result.reserve(queries);
    for (std::size_t i = 0; i < queries; ++i) {
      result.push_back(warm ? index_.permutation()[(first + i) % vertices]
                            : static_cast<VertexId>(random_() % vertices));
    }
    return result;
  }

  /// Microseconds a query.
  double time(Method method, const std::vector<VertexId>& asked, double radius) {
    const double begin = processor_seconds();
    for (const VertexId v : asked) ask(method, v, radius);
    const double seconds = processor_seconds() - begin;
    return 1e6 * seconds / static_cast<double>(asked.size());
  }

  void ask(Method method, VertexId v, double radius) {
    switch (method) {
      case BfsGiven: given_.neighborhood(v, radius, out_); break;
      case BfsReordered: in_order_.neighborhood(reordered_.place[v], radius, out_); break;
      case Ids:
        searcher_.neighborhood(v, radius, out_);
        found_ += out_.size();
        break;
      case Count: sink_ += searcher_.count(v, radius); break;
      default: sink_ += searcher_.ranges(v, radius).size();
    }
  }

  Adjacency adjacency_;
  GraphView graph_;
  Index index_;
  Reordered reordered_;
  ReferenceSearcher given_;
  ReferenceSearcher in_order_;
  Searcher searcher_;
  double mean_edge_;
  std::vector<unsigned> other_memory_;
  std::mt19937_64 random_{11};
  std::vector<VertexId> out_;
  std::size_t found_ = 0;
  std::size_t sink_ = 0;
};

/// By the clock on the wall, for several threads work at once.
double build_microseconds_per_vertex(const MeshView& mesh, unsigned threads) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const Index index = build(mesh, {.threads = threads});
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return 1e6 * best / static_cast<double>(mesh.positions.size());
}

/// A kd-tree over the same points, which knows nothing of the mesh.
double kd_tree_microseconds_per_vertex(const MeshView& mesh) {
  const PointCloud cloud(mesh.positions);
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double begin = processor_seconds();
    const KdTree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    best = std::min(best, processor_seconds() - begin);
  }
  return 1e6 * best / static_cast<double>(mesh.positions.size());
}

void run(const std::string& name, std::vector<double> radii) {
  const MeshArgument mesh(name);
  const double build_time = build_microseconds_per_vertex(mesh.view(), 1);
  const double build_time_by_two = build_microseconds_per_vertex(mesh.view(), 2);
  Bench bench(mesh.view());
  const auto vertices = static_cast<double>(bench.index().vertex_count());
  const IndexBytes bytes = bench.index().bytes();
  const auto per_vertex = [&](std::size_t part) { return static_cast<double>(part) / vertices; };
  std::printf("%s: %.0f vertices, build %.2f us a vertex (by two threads %.2f), %.2f bytes a vertex", name.c_str(),
              vertices, build_time, build_time_by_two, per_vertex(bytes.total()));
  std::printf("\nnanoflann builds a kd-tree of the points in %.2f us a vertex\n",
              kd_tree_microseconds_per_vertex(mesh.view()));
  std::printf("bytes a vertex: positions %.2f, permutation %.2f, graph %.2f, tree %.2f\n\n",
              per_vertex(bytes.positions), per_vertex(bytes.permutation), per_vertex(bytes.graph),
              per_vertex(bytes.tree));
  std::printf("| | r (edges) | k | BFS us | BFS reordered | ids | count | ranges | x ids / ranges / count |\n");
  std::printf("|--|--|--|--|--|--|--|--|--|\n");
  if (radii.empty()) radii = {2, 3, 5, 10, 20, 40, 65, 90};
  for (const bool warm : {false, true}) {
    for (const double edges : radii) bench.row(edges, warm);
  }
  bench.batch(radii.size() == 8 ? 65 : radii.back());
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: exact_speed MESH [RADIUS...]\n");
    return 2;
  }
  try {
    std::vector<double> radii;
    for (int i = 2; i < argc; ++i) radii.push_back(std::stod(argv[i]));
    meshhood::bench::run(argv[1], std::move(radii));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "exact_speed: %s\n", error.what());
    return 1;
  }
}
