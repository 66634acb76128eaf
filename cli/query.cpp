// SPDX-License-Identifier: MIT
// meshhood query: one neighborhood.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "methods.h"
#include "output.h"
#include "painting.h"
#include "query_arguments.h"

namespace meshhood::cli {
namespace {

struct Options {
  QueryArguments arguments;
  std::string method = "exact";
  std::optional<double> factor;
  bool count = false;
  bool distances = false;
  bool json = false;
  std::string output;
};

struct Answer {
  std::size_t count = 0;
  std::vector<VertexId> vertices;  ///< ascending; none where they are neither printed nor painted
  std::vector<double> distances;   ///< beside the vertices, if asked for
  double seconds = 0;
};

Answer ask(const Options& options, const Method& method, const Query& query) {
  Answer answer;
  if (options.count && options.output.empty() && method.count) {
    answer.seconds = timed_count(method, query.vertex, query.radius, answer.count);
  } else {
    answer.seconds = timed_query(method, query.vertex, query.radius, answer.vertices);
    answer.count = answer.vertices.size();
  }
  return answer;
}

Answer ask(const Options& options, Input& input, const Query& query) {
  if (options.method == "exact" || options.method == "bfs") input.need_edges("--method " + options.method);
  if (options.method == "bfs") return ask(options, bfs_method(input.graph()), query);
  if (options.method == "ball") return ask(options, ball_method(input.positions()), query);
  if (options.method == "exact") return ask(options, exact_method(input.exact_index()), query);
  const paper::QueryOptions defaults;
  const paper::QueryOptions settings{.radius_ratio = options.factor.value_or(defaults.radius_ratio)};
  return ask(options, paper_method(input.paper_index(), settings), query);
}

void add_distances(const PositionsView& positions, VertexId from, Answer& answer) {
  answer.distances.reserve(answer.vertices.size());
  for (const VertexId v : answer.vertices) answer.distances.push_back(distance(positions, from, v));
}

Json to_json(const Options& options, const Query& query, const Answer& answer) {
  Json document{
      {"vertex", query.vertex}, {"radius", query.radius}, {"method", options.method}, {"count", answer.count}};
  if (!options.count) document["vertices"] = answer.vertices;
  if (options.distances) document["distances"] = answer.distances;
  document["seconds"] = answer.seconds;
  return document;
}

std::string to_text(const Options& options, const Answer& answer) {
  if (options.count) return fmt::format("{}\n", answer.count);
  std::string text;
  for (std::size_t i = 0; i < answer.vertices.size(); ++i) {
    text += std::to_string(answer.vertices[i]);
    if (options.distances) text += fmt::format(" {}", answer.distances[i]);
    text += '\n';
  }
  return text;
}

void paint(const Options& options, Input& input, const Query& query, const Answer& answer) {
  const Color color = options.method == "ball" ? kBallColor : options.method == "paper" ? kPaperColor : kExactColor;
  Painting painting(input.vertex_count());
  painting.paint(answer.vertices, color);
  painting.paint(std::span(&query.vertex, 1), kQueryColor);
  painting.write(options.output, input.surface());
}

void query(const Options& options) {
  if (options.factor && options.method != "paper") {
    raise(ErrorCode::InvalidOption, "--factor is an option of --method paper alone");
  }
  refuse_same_file(options.arguments.file, options.output);
  Input input(options.arguments.file);
  const Query query = resolve(options.arguments, input);
  Answer answer = ask(options, input, query);
  if (options.distances) add_distances(input.positions(), query.vertex, answer);
  if (!options.output.empty()) paint(options, input, query, answer);
  options.json ? print_json(to_json(options, query, answer)) : print_text(to_text(options, answer));
}

}  // namespace

void add_query(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("query", "The neighborhood of a vertex: its vertices, one a line");
  add_query_arguments(*command, options->arguments);
  command
      ->add_option("--method", options->method,
                   "exact; bfs, exact but slow; paper, with a few extra vertices; ball, with many")
      ->check(CLI::IsMember({"exact", "bfs", "paper", "ball"}))
      ->type_name("")
      ->capture_default_str();
  command->add_option("--factor", options->factor, "f of the paper's query: greater is more exact (default 10)")
      ->type_name("NUMBER");
  CLI::Option* count = command->add_flag("--count", options->count, "only how many");
  command->add_flag("--distances", options->distances, "each vertex with its distance in space")->excludes(count);
  add_output(*command, options->output, "also write the mesh with the answer in colour, as PLY");
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { query(*options); });
}

}  // namespace meshhood::cli
