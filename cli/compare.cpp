// SPDX-License-Identifier: MIT
// meshhood compare: the methods side by side on one query.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "difference.h"
#include "input.h"
#include "methods.h"
#include "output.h"
#include "painting.h"
#include "query_arguments.h"

namespace meshhood::cli {
namespace {

struct Options {
  QueryArguments arguments;
  std::string output;
  bool json = false;
};

struct Row {
  std::string method;
  std::vector<VertexId> vertices;
  Difference difference;  ///< from the first row
  double microseconds;
};

std::vector<Row> answer(const std::vector<Method>& methods, const Query& query, std::size_t vertices) {
  std::vector<Row> rows;
  Comparison comparison(vertices);
  for (const Method& method : methods) {
    std::vector<VertexId> found;
    const double seconds = timed_query(method, query.vertex, query.radius, found);
    const Difference difference = rows.empty() ? Difference{} : comparison.compare(rows.front().vertices, found);
    rows.push_back({method.name, std::move(found), difference, 1e6 * seconds});
  }
  return rows;
}

Json to_json(const Query& query, const std::vector<Row>& rows) {
  Json methods = Json::array();
  for (const Row& row : rows) {
    methods.push_back({{"method", row.method},
                       {"count", row.vertices.size()},
                       {"extra", row.difference.extra},
                       {"missing", row.difference.missing},
                       {"microseconds", row.microseconds}});
  }
  return {{"vertex", query.vertex}, {"radius", query.radius}, {"methods", methods}};
}

std::string to_text(const std::vector<Row>& rows) {
  std::string text = "method     count     extra   missing  microseconds\n";
  for (const Row& row : rows) {
    text += fmt::format("{:<6} {:>9} {:>9} {:>9} {:>13.2f}\n", row.method, row.vertices.size(), row.difference.extra,
                        row.difference.missing, row.microseconds);
  }
  return text;
}

/// The least exact answer at the bottom, as in the paper's Figure 4. `rows`: bfs, ball, paper, ...
void paint(const std::string& file, Input& input, const Query& query, const std::vector<Row>& rows) {
  Painting painting(input.vertex_count());
  painting.paint(rows[1].vertices, kBallColor);
  painting.paint(rows[2].vertices, kPaperColor);
  painting.paint(rows[0].vertices, kExactColor);
  painting.paint(std::span(&query.vertex, 1), kQueryColor);
  painting.write(file, input.surface());
}

void compare(const Options& options) {
  refuse_same_file(options.arguments.file, options.output);
  Input input(options.arguments.file);
  input.need_edges("compare");
  const Query query = resolve(options.arguments, input);
  const std::vector<Method> methods{bfs_method(input.graph()), ball_method(input.positions()),
                                    paper_method(input.paper_index()), exact_method(input.exact_index())};
  const std::vector<Row> rows = answer(methods, query, input.vertex_count());
  if (!options.output.empty()) paint(options.output, input, query, rows);
  options.json ? print_json(to_json(query, rows)) : print_text(to_text(rows));
}

}  // namespace

void add_compare(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "compare", "The methods side by side: what each finds, how it differs from bfs, and in what time");
  add_query_arguments(*command, options->arguments);
  add_output(*command, options->output,
             "also write the mesh as PLY: the vertex red, exact green, only paper yellow, only ball blue");
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { compare(*options); });
}

}  // namespace meshhood::cli
