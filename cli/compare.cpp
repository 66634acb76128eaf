// SPDX-License-Identifier: MIT
// meshhood compare: all methods on one query.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "input.h"
#include "measure/difference.h"
#include "measure/timing.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "painting.h"

namespace meshhood::cli {
namespace {

struct CompareCommand {
  Reading reading;
  std::uint64_t vertex = 0;
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

std::vector<Row> answer(Input& input, VertexId v, double radius) {
  std::vector<Row> rows;
  measure::Comparison comparison(input.vertex_count());
  for (const char* const method : {"bfs", "ball", "paper", "exact"}) {
    AnySearcher searcher = method_of({.method = method}, input).make_searcher();
    Row row{method, {}, {}, 0};
    const auto ask = [&](auto& one) { one.neighborhood(v, radius, row.vertices); };
    row.microseconds = 1e6 * measure::median_seconds([&] { std::visit(ask, searcher); });
    std::erase_if(row.vertices, [&](VertexId w) { return input.welding().kept(w) != w; });  // the ball has them all
    if (!rows.empty()) row.difference = comparison.compare(rows.front().vertices, row.vertices);
    rows.push_back(std::move(row));
  }
  return rows;
}

Json to_json(VertexId v, double radius, const std::vector<Row>& rows) {
  Json methods = Json::array();
  for (const Row& row : rows) {
    methods.push_back({{"method", row.method},
                       {"count", row.vertices.size()},
                       {"extra", row.difference.extra},
                       {"missing", row.difference.missing},
                       {"microseconds", row.microseconds}});
  }
  return {{"vertex", v}, {"radius", radius}, {"methods", methods}};
}

std::string to_text(const std::vector<Row>& rows) {
  std::string text = "method     count     extra   missing  microseconds\n";
  for (const Row& row : rows) {
    text += fmt::format("{:<6} {:>9} {:>9} {:>9} {:>13.2f}\n", row.method, row.vertices.size(), row.difference.extra,
                        row.difference.missing, row.microseconds);
  }
  return text;
}

/// Exact answers on top, as in the paper's Figure 4. `rows`: bfs, ball, paper, exact.
void paint(const std::string& file, Input& input, VertexId v, const std::vector<Row>& rows) {
  Painting painting(input.vertex_count());
  painting.paint(rows[1].vertices, kBallColor);
  painting.paint(rows[2].vertices, kPaperColor);
  painting.paint(rows[0].vertices, kExactColor);
  painting.paint(std::span(&v, 1), kQueryColor);
  painting.write(file, input);
}

void compare(const CompareCommand& options) {
  check_outputs();
  Input input(options.reading);
  input.need_edges("compare");
  const VertexId v = resolve_vertex(options.vertex, input);
  const double radius = resolve(options.radius, input);
  const std::vector<Row> rows = answer(input, v, radius);
  if (!options.output.empty()) paint(options.output, input, v, rows);
  print_result(options.json, to_json(v, radius, rows), to_text(rows));
}

}  // namespace

void add_compare(CLI::App& program) {
  auto options = std::make_shared<CompareCommand>();
  CLI::App* command = program.add_subcommand(
      "compare", "Compare the methods on one query: size, difference from breadth-first search, time");
  add_file(*command, options->reading);
  add_number(*command, "-v,--vertex", "query vertex, by its number in the file from 0", options->vertex)->required();
  add_radius(*command, options->radius);
  add_output(
      *command, ".ply",
      "also write the mesh in color: the query vertex orange, exact green, only in paper yellow, only in ball blue",
      options->output);
  add_json(*command, options->json);
  command->callback([options] { compare(*options); });
}

}  // namespace meshhood::cli
