// SPDX-License-Identifier: MIT
// meshhood query: the neighborhoods of single vertices.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "measure/timing.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "painting.h"
#include "start.h"
#include "vertex_order.h"

namespace meshhood::cli {
namespace {

struct QueryCommand {
  std::string file;
  Reading reading;
  Radii radii;
  StartOptions start;
  MethodOptions search;
  std::string sort = "id";
  std::optional<std::string> factor;
  bool count = false;
  bool distances = false;
  bool json = false;
  std::string output;
};

struct Answer {
  std::optional<VertexId> vertex;   ///< none for --point
  std::vector<std::size_t> counts;  ///< for each radius
  std::vector<VertexId> vertices;   ///< ring by ring; empty if they are neither printed nor painted
  std::vector<double> distances;    ///< of `vertices`, if requested
  double seconds = 0;               ///< 0 if it was not measured
};

AnySearcher searcher_of(const QueryCommand& options, Input& input) {
  paper::QueryOptions settings;
  if (options.factor) settings.radius_ratio = parse_radius("--factor", *options.factor);
  return method_of(options.search, input, settings).make_searcher();
}

/// The answer of `searcher`, with the median time of several runs.
template <NeighborhoodSearcher S>
Answer timed_answer(const QueryCommand& options, S& searcher, VertexId v, double radius) {
  Answer answer{.vertex = v, .counts = {0}, .vertices = {}, .distances = {}};
  if (options.count && options.output.empty()) {
    answer.seconds = measure::median_seconds([&] { answer.counts.front() = searcher.count(v, radius); });
    return answer;
  }
  answer.seconds = measure::median_seconds([&] { searcher.neighborhood(v, radius, answer.vertices); });
  answer.counts.front() = answer.vertices.size();
  return answer;
}

/// How many of `component` are welded with vertices of other components. `first`: by vertex, the one that it becomes.
std::ptrdiff_t count_shared(const std::vector<VertexId>& component, const std::vector<VertexId>& first,
                            const Input& input) {
  std::vector<std::uint8_t> is_of_component(first.size());
  std::vector<std::uint8_t> is_shared(first.size());  // by the first vertex at each position
  for (const VertexId v : component) is_of_component[v] = 1;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (is_of_component[v] == 0 && input.welding().kept(static_cast<VertexId>(v)) == v) is_shared[first[v]] = 1;
  }
  return std::count_if(component.begin(), component.end(), [&](VertexId v) { return is_shared[first[v]] != 0; });
}

/// Names welding if vertices of other components lie where those of `component` do. If it is hardly more than a face,
/// they may also lie there but for rounding.
std::string advice_to_weld(const std::vector<VertexId>& component, Input& input) {
  constexpr std::size_t kMostOfFace = 8;
  // In an index of a welded mesh, a vertex that was not kept is a component.
  if (input.mesh() == nullptr && component.size() == 1) return "";
  const auto advice = [&](std::ptrdiff_t shared, std::string_view position, const std::string& weld) {
    return fmt::format("; {} of its vertices have {} of vertices outside it, which {} would join", shared, position,
                       (input.mesh() != nullptr ? "" : "meshhood build ") + weld);
  };
  const auto equal = count_shared(component, input.first_at_position(), input);
  if (equal != 0) return advice(equal, "the position", "--weld");
  if (component.size() == 1 || component.size() > kMostOfFace) return "";
  const std::string eps = rounding_eps(mean_edge_length(input.graph()));
  const auto near = count_shared(component, kept_vertices(input.positions(), eps_of(eps)), input);
  return near == 0 ? "" : advice(near, "nearly the position", "--weld=" + eps);
}

/// An answer of all vertices of a component is a sign of a radius in the wrong unit, or of a mesh of unconnected
/// triangles. Of several radii, `radius` is the largest.
template <NeighborhoodSearcher S>
void note_whole_component(S& searcher, double radius, const Answer& answer, Input& input) {
  if (std::isinf(radius)) return;
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  if (answer.counts.back() != searcher.count(*answer.vertex, kUnlimited)) return;
  std::vector<VertexId> component;
  searcher.neighborhood(*answer.vertex, kUnlimited, component);
  print_error("note: ",
              fmt::format("the neighborhood of vertex {} is its whole component ({} {}): a larger radius finds "
                          "no more{}",
                          *answer.vertex, component.size(), component.size() == 1 ? "vertex" : "vertices",
                          advice_to_weld(component, input)));
}

Json to_json(const QueryCommand& options, std::span<const double> radii, const Answer& answer) {
  Json document;
  if (answer.vertex) {
    document["vertex"] = *answer.vertex;
  } else {
    document["point"] = options.start.center();
  }
  if (radii.size() == 1) {
    document["radius"] = radii.front();
  } else {
    document["radii"] = radii;
  }
  document["method"] = options.search.method;
  if (!options.search.is_straight()) document["metric"] = options.search.metric;
  if (answer.counts.size() == 1) {
    document["count"] = answer.counts.front();
  } else {
    document["counts"] = answer.counts;
  }
  if (!options.count) document["vertices"] = answer.vertices;
  if (options.distances) document["distances"] = answer.distances;
  if (answer.seconds > 0) document["seconds"] = answer.seconds;
  return document;
}

/// With several answers, each line begins with the query vertex. With several radii, the radius comes before a count,
/// and after a vertex.
std::string to_text(const QueryCommand& options, std::span<const double> radii, const Answer& answer, bool is_single) {
  const std::string prefix = is_single ? "" : fmt::format("{} ", *answer.vertex);
  const bool is_nested = radii.size() > 1;
  std::string text;
  if (options.count) {
    for (std::size_t i = 0; i < answer.counts.size(); ++i) {
      text += prefix + (is_nested ? fmt::format("{} ", radii[i]) : "") + fmt::format("{}\n", answer.counts[i]);
    }
    return text;
  }
  std::size_t ring = 0;
  for (std::size_t i = 0; i < answer.vertices.size(); ++i) {
    while (i == answer.counts[ring]) ++ring;
    text += prefix + std::to_string(answer.vertices[i]);
    if (options.distances) text += fmt::format(" {}", answer.distances[i]);
    if (is_nested) text += fmt::format(" {}", radii[ring]);
    text += '\n';
  }
  return text;
}

void print(const QueryCommand& options, std::span<const double> radii, const std::vector<Answer>& answers) {
  if (!options.json) {
    for (const Answer& answer : answers) print_text(to_text(options, radii, answer, answers.size() == 1));
  } else if (answers.size() == 1) {
    print_json(to_json(options, radii, answers.front()));
  } else {
    Json documents = Json::array();
    for (const Answer& answer : answers) documents.push_back(to_json(options, radii, answer));
    print_json(documents);
  }
}

void paint(const QueryCommand& options, Input& input, const std::vector<Answer>& answers) {
  const std::string& method = options.search.method;
  const Color color = method == "ball" ? kBallColor : method == "paper" ? kPaperColor : kExactColor;
  Painting painting(input.vertex_count());
  for (const Answer& answer : answers) painting.paint(answer.vertices, color);
  for (const Answer& answer : answers) {
    if (answer.vertex) painting.paint(std::span(&*answer.vertex, 1), kQueryColor);
  }
  painting.write(options.output, input.surface());
}

std::vector<Answer> answers_of_method(const QueryCommand& options, const StartQuery& query, double radius,
                                      Input& input) {
  const std::string& method = options.search.method;
  AnySearcher chosen = searcher_of(options, input);
  VertexSorter sorter(options.sort, input);
  std::vector<Answer> answers;
  for (const QueryStart& start : query.starts) {
    const VertexId v = *start.vertex();
    const auto ask = [&](auto& searcher) {
      Answer answer = timed_answer(options, searcher, v, radius);
      if (method == "exact" || method == "bfs") note_whole_component(searcher, radius, answer, input);
      return answer;
    };
    Answer answer = std::visit(ask, chosen);
    if (options.distances || sorter.needs_distances()) {
      for (const VertexId w : answer.vertices) answer.distances.push_back(distance(input.positions(), v, w));
    }
    sorter.sort(answer.vertices, answer.distances);
    answers.push_back(std::move(answer));
  }
  return answers;
}

/// The answers that the methods do not give: from a point, with masks, in another metric, for several radii.
std::vector<Answer> answers_of_starts(const QueryCommand& options, const StartQuery& query,
                                      std::span<const double> radii, Input& input) {
  input.need_edges("this query");
  VertexSorter sorter(options.sort, input);
  std::vector<Answer> answers;
  for (const QueryStart& start : query.starts) {
    StartAnswer found = regions_of(start, options.search.metric, radii, input);
    std::size_t begin = 0;
    for (const std::size_t end : found.counts) {
      sorter.sort(std::span(found.vertices).subspan(begin, end - begin),
                  std::span(found.distances).subspan(begin, end - begin));
      begin = end;
    }
    answers.push_back({start.vertex(), std::move(found.counts), std::move(found.vertices), std::move(found.distances)});
  }
  if (options.start.is_plain() && options.search.is_straight()) {
    Searcher searcher(input.exact_index());
    for (const Answer& answer : answers) note_whole_component(searcher, radii.back(), answer, input);
  }
  return answers;
}

/// In the unit of the positions, or numbers of edges.
std::vector<double> ascending_radii(const QueryCommand& options, Input& input) {
  std::vector<double> radii = resolve(options.radii, input);
  for (std::size_t i = 1; i < radii.size(); ++i) {
    if (radii[i - 1] < radii[i]) continue;
    const std::vector<std::string>& typed = options.radii.values;
    raise(ErrorCode::InvalidRadius, fmt::format("radius {}, expected more than {} before it", typed[i], typed[i - 1]));
  }
  return radii;
}

void check_options(const QueryCommand& options) {
  const std::string& method = options.search.method;
  if (options.factor && method != "paper") raise(ErrorCode::InvalidOption, "--factor requires --method paper");
  const bool has_point = !options.start.point.empty();
  if (has_point && method != "exact") raise(ErrorCode::InvalidOption, "--point requires --method exact");
  check_method(options.search, !options.start.masks.empty(), options.radii.unit);
  const std::size_t radii = options.radii.values.size();
  if (radii > 1 && method != "exact") {
    raise(ErrorCode::InvalidOption, fmt::format("--radius: {} radii, expected one with --method {}", radii, method));
  }
  check_sort(options.sort, method);
  check_start_options(options.start, true, options.search.metric);
  check_weld(options.reading.weld, method);
}

void query_command(const QueryCommand& options) {
  check_options(options);
  check_outputs();
  Input input(options.file, options.reading);
  const StartQuery query(options.start, options.search.metric, input);
  const std::vector<double> radii = ascending_radii(options, input);
  const std::vector<Answer> answers = options.start.is_plain() && options.search.is_straight() && radii.size() == 1
                                          ? answers_of_method(options, query, radii.front(), input)
                                          : answers_of_starts(options, query, radii, input);
  if (!options.output.empty()) paint(options, input, answers);
  print(options, radii, answers);
}

}  // namespace

void add_query(CLI::App& program) {
  auto options = std::make_shared<QueryCommand>();
  CLI::App* command = program.add_subcommand("query", "Print the neighborhood of one or more vertices");
  add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_radii(*command, options->radii)
      ->description(
          "radius of the ball; a vertex at exactly this distance is inside; several, ascending: -r 1,2 or -r 1 -r 2, "
          "then each vertex is printed once, with the smallest radius whose neighborhood has it, and --count prints a "
          "line for each radius");
  add_start(*command,
            "query vertex, by its number in the file from 0; several: -v 3,7 or -v 3 -v 7, then each line of the "
            "answer begins with the query vertex",
            options->start);
  add_method(*command, options->search);
  add_sort(*command, options->sort);
  command
      ->add_option("--factor", options->factor,
                   "f of the paper's query, the ratio of the radius to that of the clusters: greater is more exact "
                   "(default 10)")
      ->type_name("NUMBER");
  CLI::Option* count = command->add_flag("--count", options->count, "print only the number of vertices");
  command
      ->add_flag("--distances", options->distances, "print each vertex with its distance, in the metric of the radius")
      ->excludes(count);
  add_output(*command, ".ply", "also write the mesh with the neighborhood in color", options->output);
  add_json(*command, options->json);
  command->callback([options] { query_command(*options); });
}

}  // namespace meshhood::cli
