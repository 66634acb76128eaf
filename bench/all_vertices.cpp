// SPDX-License-Identifier: MIT
// The neighborhoods of all vertices at one radius: breadth-first search, the exact index one query at a time, and the
// batch, with each instruction set and with two threads, interleaved in one run. Breadth-first search runs with the
// vertices in the order of the file and in index order; the faster counts. Microseconds a row, the median of the
// rounds: a table, or JSON with the times of each round. With --index, the index of the reordered mesh is saved, for
// kept_rows.
//
//   all_vertices [--json] [--index FILE] MESH [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "meshhood/meshhood.h"
#include "meshhood/reorder.h"

#include "batch/batch.h"
#include "batch/row_search.h"
#include "exact/index_access.h"
#include "io/index_io.h"
#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"
#include "two_processes.h"

namespace meshhood::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRounds = 5;
constexpr int kThreadRounds = 3;         // of calls that take longer
constexpr double kThreadSeconds = 0.25;  // of such a call on one thread, if the mesh has enough vertices

/// Consecutive vertices of the reordered mesh, from two fifths of it on.
std::vector<VertexId> consecutive_rows(std::size_t vertices, std::size_t count) {
  const std::size_t first = std::min(vertices * 2 / 5, vertices - std::min(count, vertices));
  std::vector<VertexId> rows(std::min(count, vertices));
  std::iota(rows.begin(), rows.end(), static_cast<VertexId>(first));
  return rows;
}

/// Rows that stand for all vertices of the reordered mesh: stretches of consecutive vertices, evenly spread over it. A
/// stretch is several whole groups of leaves, which are searched together.
class SpreadRows {
 public:
  /// `count`: of the rows, roughly. `groups`: in a stretch. `part`: of each stretch, for `fewer`.
  SpreadRows(const Index& index, std::size_t count, std::size_t groups, double part) {
    const std::span<const VertexId> starts = index.leaf_starts();
    const std::size_t leaves = kFanOut * groups;  // of a stretch
    const std::size_t stretches = std::max<std::size_t>(1, (starts.size() - 1) / leaves);
    const std::size_t rows = std::max<std::size_t>(1, index.vertex_count() / stretches);
    const std::size_t taken = std::clamp<std::size_t>(count / rows, 1, stretches);
    for (std::size_t i = 0; i < taken; ++i) {
      const std::size_t stretch = i * stretches / taken;
      const VertexId begin = starts[stretch * leaves];
      const VertexId end = starts[std::min((stretch + 1) * leaves, starts.size() - 1)];
      const auto end_of_part = begin + static_cast<VertexId>(part * static_cast<double>(end - begin));
      for (VertexId v = begin; v < end; ++v) all_.push_back(v);
      for (VertexId v = begin; v < end_of_part; ++v) fewer_.push_back(v);
    }
  }

  [[nodiscard]] const std::vector<VertexId>& all() const { return all_; }
  /// The first vertices of each stretch, for slow methods.
  [[nodiscard]] const std::vector<VertexId>& fewer() const { return fewer_; }

 private:
  std::vector<VertexId> all_;
  std::vector<VertexId> fewer_;
};

/// A method at one radius.
struct Timing {
  const char* name;
  std::vector<double> microseconds{};  // a row, by round
  double found = 0;                    // the mean number of vertices

  template <class F>
  void round(std::size_t rows, F&& ids_of_all, double (*clock)() = measure::processor_time) {
    const double start = clock();
    const std::uint64_t ids = ids_of_all();
    microseconds.push_back(1e6 * (clock() - start) / static_cast<double>(rows));
    found = static_cast<double>(ids) / static_cast<double>(rows);
  }

  /// Adds a round whose wall-clock time was measured outside.
  void add(std::size_t rows, double seconds) { microseconds.push_back(1e6 * seconds / static_cast<double>(rows)); }

  [[nodiscard]] double median() const {
    std::vector<double> sorted = microseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of all threads.
double process_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One for each instruction set that this processor has.
std::vector<Timing> timings_by_isa() {
  std::vector<Timing> timings;
  for (std::size_t isa = 0; isa <= static_cast<std::size_t>(best_isa()); ++isa) {
    timings.push_back(Timing{name_of(static_cast<Isa>(isa))});
  }
  return timings;
}

/// The methods in the order of the table. `one_thread` and `two_threads` count more rows at once, and their wall-clock
/// time is measured, and as `work` their processor time; `two_processes` is that of two processes, each of which counts
/// all of these rows. Those of `by_isa` count by one worker of the batch each.
struct Row {
  double edges;
  double radius;
  std::vector<VertexId> kept;  // consecutive vertices, for kept_rows
  std::size_t thread_rows = 0;
  Timing bfs{"bfs"};
  Timing single_count{"single_count"};
  Timing single_ids{"single_ids"};
  Timing count{"count"};
  Timing ids{"ids"};
  Timing one_thread{"one_thread"};
  Timing two_threads{"two_threads"};
  Timing two_processes{"two_processes"};
  Timing one_thread_work{"one_thread_work"};
  Timing two_threads_work{"two_threads_work"};
  std::vector<Timing> by_isa = timings_by_isa();

  void print() const {
    std::printf("%6.4g %8.0f %9.3f %8.3f %8.3f %8.3f %8.3f %8.1f %6.1f %8.1f %6.1f", edges, ids.found, bfs.median(),
                single_count.median(), single_ids.median(), count.median(), ids.median(), bfs.median() / count.median(),
                bfs.median() / ids.median(), single_count.median() / count.median(),
                single_ids.median() / ids.median());
    std::printf("%10.2f", one_thread.median() / two_threads.median());
    if (!two_processes.microseconds.empty()) std::printf(" (%.2f)", 2 * one_thread.median() / two_processes.median());
    const Timing& best = by_isa.back();
    for (const Timing& isa : by_isa) {
      if (!isa.microseconds.empty()) std::printf("%10.2f", best.median() / isa.median());
    }
    std::printf("\n");
    std::fflush(stdout);
  }

  [[nodiscard]] Json json() const {
    Json result{{"radius_edges", edges}, {"radius", radius},           {"first_vertex", kept.front()},
                {"rows", kept.size()},   {"thread_rows", thread_rows}, {"found", ids.found}};
    const auto add = [&](const Timing& timing) {
      if (!timing.microseconds.empty()) result[timing.name] = timing.microseconds;
    };
    for (const Timing* timing : {&bfs, &single_count, &single_ids, &count, &ids, &one_thread, &two_threads,
                                 &two_processes, &one_thread_work, &two_threads_work}) {
      add(*timing);
    }
    for (const Timing& timing : by_isa) add(timing);
    return result;
  }
};

class AllVertices {
 public:
  explicit AllVertices(const MeshView& mesh)
      : mesh_(reorder(mesh)), bfs_(mesh_.view()), bfs_as_given_(mesh), searcher_(mesh_.index) {
    mean_edge_ = mean_edge_length({mesh_.view().positions, bfs_.adjacency()});
  }

  [[nodiscard]] std::size_t vertices() const { return mesh_.index.vertex_count(); }

  void save(const std::string& path) const { io::save(path, mesh_.index); }

  Row measure(double edges) {
    const double radius = edges * mean_edge_;
    const bool is_small = edges <= 10;
    const SpreadRows spread =
        is_small ? SpreadRows(mesh_.index, 40000, 4, 0.125) : SpreadRows(mesh_.index, 4000, 2, 0.1);
    const std::vector<VertexId>& rows = spread.all();
    const std::vector<VertexId>& fewer = spread.fewer();
    std::vector<VertexId> as_given;
    for (const VertexId v : fewer) as_given.push_back(mesh_.permutation[v]);
    Timing bfs_as_given{"bfs"};
    Row result{.edges = edges, .radius = radius, .kept = consecutive_rows(vertices(), is_small ? 20000 : 3000)};
    for (int round = 0; round < kRounds; ++round) {
      result.bfs.round(fewer.size(), [&] { return ids_one_by_one(bfs_, fewer, radius); });
      bfs_as_given.round(fewer.size(), [&] { return ids_one_by_one(bfs_as_given_, as_given, radius); });
      result.single_count.round(fewer.size(), [&] { return counts_one_by_one(fewer, radius); });
      result.single_ids.round(fewer.size(), [&] { return ids_one_by_one(searcher_, fewer, radius); });
      result.count.round(rows.size(), [&] { return counts_of_batch(rows, radius, 1); });
      result.ids.round(rows.size(), [&] { return ids_of_batch(rows, radius); });
      for (std::size_t isa = 0; isa < result.by_isa.size(); ++isa) {
        result.by_isa[isa].round(rows.size(), [&] { return counts_of_worker(static_cast<Isa>(isa), rows, radius); });
      }
    }
    if (bfs_as_given.median() < result.bfs.median()) result.bfs = bfs_as_given;
    measure_threads(result);
    return result;
  }

 private:
  void measure_threads(Row& row) {
    row.thread_rows = static_cast<std::size_t>(1e6 * kThreadSeconds / row.count.median());
    const std::vector<VertexId> rows = consecutive_rows(vertices(), row.thread_rows);
    row.thread_rows = rows.size();
    const auto count = [&](unsigned threads) { return counts_of_batch(rows, row.radius, threads); };
    const auto measure_count = [&](unsigned threads, Timing& wall, Timing& work) {
      const double start = process_time();
      wall.round(rows.size(), [&] { return count(threads); }, wall_clock);
      work.add(rows.size(), process_time() - start);
    };
    for (int round = 0; round < kThreadRounds; ++round) {
      measure_count(1, row.one_thread, row.one_thread_work);
      measure_count(2, row.two_threads, row.two_threads_work);
      if (const auto processors = two_processors()) {
        row.two_processes.add(rows.size(), two_processes(*processors, [&] { count(1); }));
      }
    }
  }

  template <class S>
  std::uint64_t ids_one_by_one(S& searcher, std::span<const VertexId> rows, double radius) {
    std::uint64_t ids = 0;
    for (const VertexId v : rows) {
      searcher.neighborhood(v, radius, ids_);
      ids += ids_.size();
    }
    return ids;
  }

  std::uint64_t counts_one_by_one(std::span<const VertexId> rows, double radius) {
    std::uint64_t ids = 0;
    for (const VertexId v : rows) ids += searcher_.count(v, radius);
    return ids;
  }

  std::uint64_t counts_of_batch(const std::vector<VertexId>& rows, double radius, unsigned threads) {
    std::uint64_t ids = 0;
    for (const std::uint64_t size : counts(mesh_.index, {.vertices = rows, .radius = radius}, {.threads = threads})) {
      ids += size;
    }
    return ids;
  }

  /// One worker, which receives the batch group by group.
  std::uint64_t counts_of_worker(Isa isa, std::span<const VertexId> rows, double radius) {
    BatchWorker worker(make_straight_rows(mesh_.index, Metric::Straight, isa));
    const auto position_of = [&](VertexId v) { return IndexAccess::view(mesh_.index).slot[v]; };
    const auto group_of = [&](VertexId v) { return position_of(v) / kGroupPositions; };
    std::vector<BatchItem> chunk;
    std::uint64_t ids = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      chunk.push_back({row, rows[row], position_of(rows[row]), radius});
      if (row + 1 < rows.size() && group_of(rows[row]) == group_of(rows[row + 1])) continue;
      const auto add = [&](std::span<const BatchItem> /*rows*/, std::span<const std::uint64_t> sizes) {
        ids = std::accumulate(sizes.begin(), sizes.end(), ids);
        return true;
      };
      worker.count(chunk, add, nullptr, false);
      chunk.clear();
    }
    return ids;
  }

  std::uint64_t ids_of_batch(const std::vector<VertexId>& rows, double radius) {
    std::uint64_t ids = 0;
    for_each_neighborhood(mesh_.index, {.vertices = rows, .radius = radius},
                          [&](const BatchRow& row) { ids += row.ids.size(); }, {.in_index_order = true},
                          {.threads = 1});
    return ids;
  }

  ReorderedMesh mesh_;
  ReferenceSearcher bfs_;  // in index order
  ReferenceSearcher bfs_as_given_;
  Searcher searcher_;
  double mean_edge_ = 0;
  std::vector<VertexId> ids_;
};

void print_table(AllVertices& all, const std::vector<double>& radii) {
  std::printf("microseconds a row; x: times as fast as\n");
  std::string targets;
  for (const Timing& isa : timings_by_isa()) targets += (targets.empty() ? std::string() : ", ") + isa.name;
  std::printf("%6s %8s %9s %17s %17s %15s %15s %20s  %s\n", "edges", "vertices", "BFS", "one: count, ids",
              "batch: count, ids", "x BFS", "x one", "threads (processes)", (targets + " / best").c_str());
  for (const double edges : radii) all.measure(edges).print();
}

void print_json(AllVertices& all, const std::vector<double>& radii) {
  Json rows = Json::array();
  for (const double edges : radii) rows.push_back(all.measure(edges).json());
  std::printf("%s\n", Json{{"vertices", all.vertices()}, {"rows", rows}}.dump().c_str());
}

/// Removes `name` from the front of the arguments, and `more` of them behind it, of which it returns the last.
std::string take(std::vector<std::string>& arguments, const char* name, std::size_t more) {
  if (arguments.size() <= more || arguments.front() != name) return "";
  const std::string last = arguments[more];
  arguments.erase(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(more) + 1);
  return last;
}

int run(Arguments arguments) {
  const bool json = !take(arguments, "--json", 0).empty();
  const std::string index = take(arguments, "--index", 1);
  if (arguments.empty()) throw std::invalid_argument("a mesh is missing");
  AllVertices all(MeshArgument(arguments.front()).view());
  if (!index.empty()) all.save(index);
  const std::vector<double> radii = numbers(arguments, 1, {2, 3, 5, 10, 20, 65});
  json ? print_json(all, radii) : print_table(all, radii);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(
      argc, argv, {"all_vertices [--json] [--index FILE] MESH [RADIUS IN MEAN EDGES...]", 1}, meshhood::bench::run);
}
