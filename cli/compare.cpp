// SPDX-License-Identifier: MIT
// meshhood compare: all methods on one query.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/batch.h"
#include "meshhood/paper.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "commands.h"
#include "input.h"
#include "measure/difference.h"
#include "measure/timing.h"
#include "mesh_file.h"
#include "options.h"
#include "output.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct CompareCommand {
  Reading reading;
  std::optional<std::uint64_t> vertex;
  Radius radius;
  std::string output;
  bool json = false;
};

struct Row {
  std::string method;
  std::vector<VertexId> vertices;
  measure::Difference difference;  ///< from the first row
  double microseconds;
};

AnySearcher searcher_of(std::string_view method, Input& input) {
  if (method == "bfs") return ReferenceSearcher(input.graph());
  if (method == "ball") return BallSearcher(input.positions());
  if (method == "paper") return paper::Searcher(input.paper_index());
  return Searcher(input.exact_index());
}

void find(AnySearcher& searcher, VertexId v, double radius, std::vector<VertexId>& vertices) {
  std::visit([&](auto& one) { one.neighborhood(v, radius, vertices); }, searcher);
}

/// The ball has the vertices that have become others by welding, too.
void drop_welded(const Input& input, std::vector<VertexId>& vertices) {
  std::erase_if(vertices, [&](VertexId w) { return input.welding().kept(w) != w; });
}

/// Of some 200 vertices spread over the mesh, the one at which the largest part of the ball does not belong to the
/// neighborhood; one at which the paper's answer differs, too, comes first.
VertexId most_different(Input& input, double radius) {
  constexpr std::size_t kCandidates = 200;
  AnySearcher ball = searcher_of("ball", input);
  AnySearcher paper = searcher_of("paper", input);
  AnySearcher exact = searcher_of("exact", input);
  std::vector<VertexId> vertices;
  const auto count = [&](AnySearcher& searcher, VertexId v) {
    find(searcher, v, radius, vertices);
    drop_welded(input, vertices);
    return static_cast<double>(vertices.size());
  };
  std::pair<bool, double> most{false, -1};
  VertexId found = 0;
  const std::size_t step = std::max<std::size_t>(1, input.vertex_count() / kCandidates);
  for (std::size_t i = 0; i < input.vertex_count(); i += step) {
    Task::check_cancelled();
    const VertexId v = input.welding().kept(static_cast<VertexId>(i));
    const double size = count(exact, v);
    const std::pair difference{count(paper, v) > size, 1 - size / count(ball, v)};
    if (difference > most) {
      most = difference;
      found = v;
    }
  }
  return found;
}

std::vector<Row> answer(Input& input, VertexId v, double radius) {
  std::vector<Row> rows;
  measure::Comparison comparison(input.vertex_count());
  for (const char* const method : {"bfs", "ball", "paper", "exact"}) {
    AnySearcher searcher = searcher_of(method, input);
    Row row{method, {}, {}, 0};
    row.microseconds = 1e6 * measure::median_seconds([&] { find(searcher, v, radius, row.vertices); });
    drop_welded(input, row.vertices);
    if (!rows.empty()) row.difference = comparison.compare(rows.front().vertices, row.vertices);
    rows.push_back(std::move(row));
  }
  return rows;
}

void print(bool json, VertexId v, double radius, const std::vector<Row>& rows) {
  Json methods = Json::array();
  std::string text = fmt::format("vertex {}\nmethod     count     extra   missing  microseconds\n", v);
  for (const auto& [method, vertices, difference, microseconds] : rows) {
    methods.push_back({{"method", method},
                       {"count", vertices.size()},
                       {"extra", difference.extra},
                       {"missing", difference.missing},
                       {"microseconds", microseconds}});
    text += fmt::format("{:<6} {:>9} {:>9} {:>9} {:>13.2f}\n", method, vertices.size(), difference.extra,
                        difference.missing, microseconds);
  }
  print_result(json, {{"vertex", v}, {"radius", radius}, {"methods", methods}}, text);
}

/// Exact answers on top, as in the paper's Figure 4. `rows`: bfs, ball, paper, exact.
void paint(const std::string& file, Input& input, VertexId v, const std::vector<Row>& rows) {
  write_painting(file, input,
                 {{rows[1].vertices, kBallColor},
                  {rows[2].vertices, kPaperColor},
                  {rows[0].vertices, kExactColor},
                  {std::span(&v, 1), kQueryColor}});
}

void compare(const CompareCommand& options) {
  check_outputs();
  Input input(options.reading);
  input.need_edges("compare");
  input.need_positions("compare");
  const double radius = resolve(options.radius, input);
  const VertexId v = options.vertex ? resolve_vertex(*options.vertex, input) : most_different(input, radius);
  const std::vector<Row> rows = answer(input, v, radius);
  if (!options.output.empty()) paint(options.output, input, v, rows);
  print(options.json, v, radius, rows);
}

}  // namespace

void add_compare(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "compare",
                  "Compare the methods on one query: size, difference from breadth-first search, time", compare);
  add_file(command, options.reading);
  add_number(
      command, "-v,--vertex",
      "query vertex, by its number in the file from 0; without it, one at which the methods differ is searched for",
      options.vertex);
  add_radius(command, options.radius);
  add_output(
      command, ".ply",
      "also write the mesh in color: the query vertex orange, exact green, only in paper yellow, only in ball blue",
      options.output);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
