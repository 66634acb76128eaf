// SPDX-License-Identifier: MIT
// meshhood query: the neighborhoods of single vertices.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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
#include "mesh_file.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "start.h"
#include "table_file.h"

namespace meshhood::cli {
namespace {

struct QueryCommand {
  Reading reading;
  Radii radii;
  StartOptions start;
  MethodOptions search;
  std::optional<std::string> factor;
  bool count = false;
  bool distances = false;
  bool json = false;
  TableFile output;

  [[nodiscard]] bool is_painted() const { return !output.name.empty() && !output.is_csv(); }
};

/// How many of `component` are welded with vertices of other components. `first`: by vertex, the one that it becomes.
std::ptrdiff_t count_shared(const std::vector<VertexId>& component, const std::vector<VertexId>& first,
                            const Input& input) {
  std::vector<std::uint8_t> is_of_component(first.size());
  std::vector<std::uint8_t> is_shared(first.size());  // by the first vertex at each position
  for (const VertexId v : component) is_of_component[v] = 1;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (input.is_wall(static_cast<VertexId>(v))) continue;
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
/// triangles. Of several radii, `radius` is the largest. A part knows no component of the mesh.
template <NeighborhoodSearcher S>
void note_whole_component(S& searcher, double radius, const Answer& answer, Input& input) {
  if (std::isinf(radius) || input.is_wall(*answer.vertex) || input.plan() != nullptr) return;
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

Json to_json(const QueryCommand& options, const Answer& answer) {
  Json document;
  if (answer.vertex) {
    document["vertex"] = *answer.vertex;
  } else {
    document["point"] = parse_point(options.start.point);
  }
  document["counts"] = answer.counts;
  if (!options.count) document["vertices"] = answer.vertices;
  if (options.distances) document["distances"] = answer.distances;
  return document;
}

/// Text for people, with the functions of `CsvWriter`.
class TextWriter {
 public:
  template <class Number>
  void add(Number number) {
    text_ += fmt::format("{}{}", text_.empty() || text_.back() == '\n' ? "" : " ", number);
  }
  void end_row() { text_ += '\n'; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A line begins with the query vertex if there may be several. With several radii, the radius comes before a count,
/// and after a vertex.
template <class Writer>
void write_lines(Writer& writer, const QueryCommand& options, std::span<const double> radii, const Answer& answer,
                 bool has_vertex) {
  const bool is_nested = radii.size() > 1;
  if (options.count) {
    for (std::size_t i = 0; i < answer.counts.size(); ++i) {
      if (has_vertex) writer.add(*answer.vertex);
      if (is_nested) writer.add(radii[i]);
      writer.add(answer.counts[i]);
      writer.end_row();
    }
    return;
  }
  std::size_t ring = 0;
  for (std::size_t i = 0; i < answer.vertices.size(); ++i) {
    while (i == answer.counts[ring]) ++ring;
    if (has_vertex) writer.add(*answer.vertex);
    writer.add(answer.vertices[i]);
    if (options.distances) writer.add(answer.distances[i]);
    if (is_nested) writer.add(radii[ring]);
    writer.end_row();
  }
}

/// The lines of the text, always with the query vertex, which a point has not.
void write_answers(const QueryCommand& options, std::span<const double> radii, const std::vector<Answer>& answers) {
  std::vector<std::string> names = options.count ? std::vector<std::string>{"vertex"} : pair_names(options.distances);
  if (radii.size() > 1) names.emplace_back("radius");
  if (options.count) names.emplace_back("count");
  const bool has_vertex = options.start.point.empty();
  if (!has_vertex) names.erase(names.begin());
  CsvWriter csv(options.output.name, names);
  for (const Answer& answer : answers) write_lines(csv, options, radii, answer, has_vertex);
  csv.commit();
}

void print(const QueryCommand& options, std::span<const double> radii, const std::vector<Answer>& answers) {
  if (options.output.is_csv()) {
    const std::string& output = options.output.name;
    return print_result(options.json, {{"output", output}, {"rows", answers.size()}},
                        fmt::format("{}: {} answers\n", printable_name(output), answers.size()));
  }
  if (options.json) {
    Json documents = Json::array();
    for (const Answer& answer : answers) documents.push_back(to_json(options, answer));
    return print_json({{"method", options.search.method},
                       {"metric", options.search.metric},
                       {"radii", radii},
                       {"answers", std::move(documents)}});
  }
  for (const Answer& answer : answers) {
    TextWriter text;
    write_lines(text, options, radii, answer, options.start.is_list());
    print_text(text.text());
  }
}

void paint(const QueryCommand& options, Input& input, const std::vector<Answer>& answers) {
  const std::string& method = options.search.method;
  const Color color = method == "ball" ? kBallColor : method == "paper" ? kPaperColor : kExactColor;
  std::vector<Layer> layers;
  for (const Answer& answer : answers) layers.push_back({answer.vertices, color});
  for (const Answer& answer : answers) {
    if (answer.vertex) layers.push_back({std::span(&*answer.vertex, 1), kQueryColor});
  }
  write_painting(options.output.name, input, layers);
}

/// The ratio of the radius to the size of clusters, of the method of the paper.
double parse_factor(const std::string& text) {
  const auto number = parse_number(text);
  if (number && *number > 0 && *number < kInfinity) return *number;
  raise(ErrorCode::InvalidOption, fmt::format("--factor {}, expected a finite number > 0", io::quote(text)));
}

std::vector<Answer> answers_of_method(const QueryCommand& options, std::span<const QueryStart> starts, double radius,
                                      Input& input) {
  const std::string& method = options.search.method;
  paper::QueryOptions settings;
  if (options.factor) settings.radius_ratio = parse_factor(*options.factor);
  AnySearcher chosen = method_of(options.search, input, settings).make_searcher();
  RowOrder order = row_order(options.search.sort, input);
  std::vector<Answer> answers;
  for (const QueryStart& start : starts) {
    const VertexId v = *start.vertex();
    const auto ask = [&](auto& searcher) {
      Answer answer{.vertex = v};
      if (options.count && !options.is_painted()) {
        answer.counts = {searcher.count(v, radius)};
      } else {
        searcher.neighborhood(v, radius, answer.vertices);
        answer.counts = {answer.vertices.size()};
      }
      if (method == "exact" || method == "bfs") note_whole_component(searcher, radius, answer, input);
      return answer;
    };
    Answer answer = std::visit(ask, chosen);
    if (options.distances || order.needs_distances()) {
      for (const VertexId w : answer.vertices) answer.distances.push_back(distance(input.positions(), v, w));
    }
    order.sort(answer.vertices, answer.distances);
    answers.push_back(std::move(answer));
  }
  return answers;
}

/// The answers of the exact method from a point, with masks, in another metric, or for several radii.
std::vector<Answer> answers_of_starts(const QueryCommand& options, std::span<const QueryStart> starts,
                                      std::span<const double> radii, Input& input) {
  input.need_edges("this query");
  RowOrder order = row_order(options.search.sort, input);
  std::vector<Answer> answers;
  RegionSearch search(options.search.metric, input);
  for (const QueryStart& start : starts) {
    Answer found = search.regions(start, radii);
    std::size_t begin = 0;
    for (const std::size_t end : found.counts) {
      order.sort(std::span(found.vertices).subspan(begin, end - begin),
                 std::span(found.distances).subspan(begin, end - begin));
      begin = end;
    }
    answers.push_back(std::move(found));
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
  if (options.factor && method != "paper") wrong_option("--factor requires --method paper");
  const bool has_point = !options.start.point.empty();
  if (has_point && method != "exact") wrong_option("--point requires --method exact");
  check_method(options.search, options.reading, !options.start.masks.empty(), options.radii.unit);
  const std::size_t radii = options.radii.values.size();
  if (radii > 1 && method != "exact") {
    wrong_option("--radius: {} radii, expected one with --method {}", radii, method);
  }
  check_start_options(options.start, true, options.search.metric);
}

void query_command(const QueryCommand& options) {
  check_options(options);
  check_outputs();
  Input input(options.reading);
  const std::vector<QueryStart> starts = starts_of(options.start, options.search.metric, input);
  const std::vector<double> radii = ascending_radii(options, input);
  const bool is_of_method = options.search.method != "exact" ||
                            (options.start.is_plain() && options.search.is_straight() && radii.size() == 1);
  const std::vector<Answer> answers = is_of_method ? answers_of_method(options, starts, radii.front(), input)
                                                   : answers_of_starts(options, starts, radii, input);
  if (options.is_painted()) paint(options, input, answers);
  if (options.output.is_csv()) write_answers(options, radii, answers);
  print(options, radii, answers);
}

}  // namespace

void add_query(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "query", "Print the neighborhood of one or more vertices", query_command);
  add_file(command, options.reading);
  add_radii(command, options.radii)
      ->description(
          "radius of the ball; a vertex at exactly this distance is inside; several, ascending: -r 1,2 or -r 1 -r 2, "
          "then each vertex is printed once, with the smallest radius whose neighborhood has it, and --count prints a "
          "line for each radius");
  add_start(
      command,
      "query vertex, by its number in the file from 0; several: -v 3,7 or -v 3 -v 7, or -v - for a list on standard "
      "input, one in each line; then each line of the answer begins with the query vertex",
      options.start);
  add_method(command, options.search);
  command
      .add_option("--factor", options.factor,
                  "f of the paper's query, the ratio of the radius to that of the clusters: greater is more exact "
                  "(default 10)")
      ->type_name("NUMBER");
  CLI::Option* count = command.add_flag("--count", options.count, "print only the number of vertices");
  command
      .add_flag("--distances", options.distances, "print each vertex with its distance, in the metric of the radius")
      ->excludes(count);
  add_table_output(command, ".ply", "the mesh with the neighborhood in color, beside the answer, or a table instead",
                   options.output);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
