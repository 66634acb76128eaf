// SPDX-License-Identifier: MIT
// The neighborhoods of all vertices at one radius, on one thread: breadth-first search on the reordered mesh, the exact
// index one query at a time, and the batch, interleaved in one run. Microseconds a row, the median of the rounds: a
// table, or JSON with the times of each round.
//
//   all_vertices [--json] MESH [RADIUS IN MEAN EDGES...]
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "meshhood/meshhood.h"
#include "meshhood/reorder.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRounds = 5;

/// Consecutive vertices of the reordered mesh, from two fifths of it on.
std::vector<VertexId> contiguous_rows(std::size_t vertices, std::size_t count) {
  const std::size_t first = std::min(vertices * 2 / 5, vertices - std::min(count, vertices));
  std::vector<VertexId> rows(std::min(count, vertices));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<VertexId>(first + i);
  return rows;
}

/// A method at one radius.
struct Timing {
  const char* name;
  std::vector<double> microseconds{};  // a row, by round
  double found = 0;                    // the mean number of vertices

  template <class F>
  void round(std::size_t rows, F&& ids_of_all) {
    const double start = measure::processor_time();
    const std::uint64_t ids = ids_of_all();
    microseconds.push_back(1e6 * (measure::processor_time() - start) / static_cast<double>(rows));
    found = static_cast<double>(ids) / static_cast<double>(rows);
  }

  [[nodiscard]] double median() const {
    std::vector<double> sorted = microseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// The methods in the order of the table.
struct Row {
  double edges;
  std::array<Timing, 5> timings{Timing{"bfs"}, Timing{"single_count"}, Timing{"single_ids"}, Timing{"count"},
                                Timing{"ids"}};

  void print() const {
    const auto& [bfs, single_count, single_ids, count, ids] = timings;
    std::printf("%6.4g %8.0f %9.3f %8.3f %8.3f %8.3f %8.3f %8.1f %6.1f %8.1f %6.1f\n", edges, ids.found, bfs.median(),
                single_count.median(), single_ids.median(), count.median(), ids.median(), bfs.median() / count.median(),
                bfs.median() / ids.median(), single_count.median() / count.median(),
                single_ids.median() / ids.median());
    std::fflush(stdout);
  }

  [[nodiscard]] Json json() const {
    Json result{{"radius_edges", edges}, {"found", timings.back().found}};
    for (const Timing& timing : timings) result[timing.name] = timing.microseconds;
    return result;
  }
};

class AllVertices {
 public:
  explicit AllVertices(const MeshView& mesh) : mesh_(reorder(mesh)), reference_(mesh_.view()), searcher_(mesh_.index) {
    mean_edge_ = mean_edge_length({mesh_.view().positions, reference_.adjacency()});
  }

  [[nodiscard]] std::size_t vertices() const { return mesh_.index.vertex_count(); }

  Row measure(double edges) {
    const double radius = edges * mean_edge_;
    const std::vector<VertexId> rows = contiguous_rows(vertices(), edges <= 10 ? 20000 : 3000);
    // Slow methods take a part of the rows.
    const std::span<const VertexId> fewer =
        std::span(rows).first(std::min<std::size_t>(rows.size(), edges <= 10 ? 4000 : 400));
    Row result{edges};
    auto& [bfs, single_count, single_ids, count, ids] = result.timings;
    for (int round = 0; round < kRounds; ++round) {
      bfs.round(fewer.size(), [&] { return ids_one_by_one(reference_, fewer, radius); });
      single_count.round(fewer.size(), [&] { return counts_one_by_one(fewer, radius); });
      single_ids.round(fewer.size(), [&] { return ids_one_by_one(searcher_, fewer, radius); });
      count.round(rows.size(), [&] { return counts_of_batch(rows, radius); });
      ids.round(rows.size(), [&] { return ids_of_batch(rows, radius); });
    }
    return result;
  }

 private:
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

  std::uint64_t counts_of_batch(const std::vector<VertexId>& rows, double radius) {
    std::uint64_t ids = 0;
    for (const std::uint64_t size : neighborhood_sizes(mesh_.index, {.vertices = rows, .radius = radius})) ids += size;
    return ids;
  }

  std::uint64_t ids_of_batch(const std::vector<VertexId>& rows, double radius) {
    std::uint64_t ids = 0;
    for_each_neighborhood(mesh_.index, {.vertices = rows, .radius = radius},
                          [&](const BatchRow& row) { ids += row.ids.size(); }, {.in_index_order = true});
    return ids;
  }

  ReorderedMesh mesh_;
  ReferenceSearcher reference_;
  Searcher searcher_;
  double mean_edge_ = 0;
  std::vector<VertexId> ids_;
};

void print_table(AllVertices& all, const std::vector<double>& radii) {
  std::printf("microseconds a row; x: times as fast as\n");
  std::printf("%6s %8s %9s %17s %17s %15s %15s\n", "edges", "vertices", "BFS", "one: count, ids", "batch: count, ids",
              "x BFS", "x one");
  for (const double edges : radii) all.measure(edges).print();
}

void print_json(AllVertices& all, const std::vector<double>& radii) {
  Json rows = Json::array();
  for (const double edges : radii) rows.push_back(all.measure(edges).json());
  std::printf("%s\n", Json{{"vertices", all.vertices()}, {"rows", rows}}.dump().c_str());
}

int run(std::vector<std::string> arguments) {
  const bool json = !arguments.empty() && arguments.front() == "--json";
  if (json) arguments.erase(arguments.begin());
  if (arguments.empty()) {
    std::fprintf(stderr, "usage: all_vertices [--json] MESH [RADIUS IN MEAN EDGES...]\n");
    return 2;
  }
  AllVertices all(MeshArgument(arguments.front()).view());
  std::vector<double> radii;
  for (std::size_t i = 1; i < arguments.size(); ++i) radii.push_back(std::stod(arguments[i]));
  if (radii.empty()) radii = {2, 3, 5, 10, 20, 65};
  json ? print_json(all, radii) : print_table(all, radii);
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::exit_status("all_vertices", [&] { return meshhood::bench::run({argv + 1, argv + argc}); });
}
