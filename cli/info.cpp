// SPDX-License-Identifier: MIT
// meshhood info: properties of a mesh or an index.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "input.h"
#include "io/weld.h"
#include "options.h"
#include "output.h"

namespace meshhood::cli {
namespace {

struct InfoCommand {
  Reading reading;
  bool index = false;
  bool json = false;
};

struct Box {
  std::array<double, 3> min;
  std::array<double, 3> max;
};

/// Of the distinct edges, which connect vertices, not positions.
struct EdgeCounts {
  std::size_t all = 0;
  std::size_t border = 0;       ///< in one face
  std::size_t nonmanifold = 0;  ///< in more than two faces
};

/// The number of faces by that of their corners.
std::map<std::size_t, std::size_t> polygon_degrees(const FacesView& faces) {
  std::map<std::size_t, std::size_t> degrees;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) { ++degrees[corners.size()]; });
  return degrees;
}

/// Corners whose vertex occurs earlier in the same face.
std::size_t repeated_corners(const FacesView& faces) {
  std::size_t repeated = 0;
  std::vector<VertexId> sorted;
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    sorted.assign(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    repeated += static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
  });
  return repeated;
}

/// The edges of all faces as sorted pairs, sorted: an edge occurs once for each of its faces.
std::vector<std::pair<VertexId, VertexId>> sides(const FacesView& faces) {
  std::vector<std::pair<VertexId, VertexId>> all;
  all.reserve(faces.corners().size());
  faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VertexId a = corners[i];
      const VertexId b = corners[i + 1 < corners.size() ? i + 1 : 0];
      if (a != b) all.emplace_back(std::min(a, b), std::max(a, b));
    }
  });
  std::sort(all.begin(), all.end());
  return all;
}

EdgeCounts count_edges(const FacesView& faces) {
  EdgeCounts counts;
  const auto all = sides(faces);
  for (auto edge = all.begin(); edge != all.end();) {
    const auto next = std::find_if(edge, all.end(), [&](const auto& other) { return other != *edge; });
    ++counts.all;
    counts.border += next - edge == 1 ? 1 : 0;
    counts.nonmanifold += next - edge > 2 ? 1 : 0;
    edge = next;
  }
  return counts;
}

/// For each vertex: whether it is in no face.
std::vector<char> mark_isolated(const MeshView& mesh) {
  std::vector<char> done(mesh.positions.size(), 1);
  mesh.faces.for_each([&](std::size_t, std::span<const VertexId> corners) {
    for (const VertexId v : corners) done[v] = 0;
  });
  return done;
}

std::size_t count_isolated(const MeshView& mesh) {
  const std::vector<char> isolated = mark_isolated(mesh);
  return static_cast<std::size_t>(std::ranges::count(isolated, 1));
}

void mark_component(const AdjacencyView& adjacency, std::size_t start, std::vector<char>& done,
                    std::vector<VertexId>& stack) {
  stack.assign(1, static_cast<VertexId>(start));
  done[start] = 1;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    for (const VertexId w : adjacency[v]) {
      if (done[w] == 0) stack.push_back(w);
      done[w] = 1;
    }
  }
}

/// #V minus the number of distinct positions. Walls do not count: they are where another vertex is.
std::size_t repeated_positions(const io::Mesh& mesh) {
  const std::vector<VertexId> ids = io::welded_ids(mesh.view().positions);
  const std::size_t repeated = ids.empty() ? 0 : ids.size() - 1 - std::ranges::max(ids);
  return repeated - std::min(repeated, static_cast<std::size_t>(std::ranges::count(mesh.walls, 1)));
}

/// None of a mesh without vertices.
std::optional<Box> bounds(const PositionsView& positions) {
  if (positions.size() == 0) return std::nullopt;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  positions.visit([&](const auto& xyz) {
    for (std::size_t i = 0; i < 3 * xyz.size(); ++i) {
      const auto value = static_cast<double>(xyz(i / 3, i % 3));
      box.min[i % 3] = std::min(box.min[i % 3], value);
      box.max[i % 3] = std::max(box.max[i % 3], value);
    }
  });
  return box;
}

/// Components connected by edges, without isolated vertices. `adjacency`: that of `mesh`. O(#V + #corners).
std::size_t count_components(const MeshView& mesh, const AdjacencyView& adjacency) {
  std::vector<char> done = mark_isolated(mesh);
  std::vector<VertexId> stack;
  std::size_t components = 0;
  for (std::size_t v = 0; v < done.size(); ++v) {
    if (done[v] != 0) continue;
    mark_component(adjacency, v, done, stack);
    ++components;
  }
  return components;
}

/// What is printed, as JSON and as text.
struct Report {
  Json document;
  std::string text;

  void add_line(std::string_view name, std::string_view value) { text += fmt::format("{:<19} {}\n", name, value); }

  void add(const char* key, std::string_view name, const Json& value, std::string_view shown) {
    document[key] = value;
    add_line(name, shown);
  }
  void add(const char* key, std::string_view name, std::uint64_t value) {
    add(key, name, value, std::to_string(value));
  }
};

/// `has_siblings`: whether those of a cluster are counted on all levels, rather than on that of the leaves alone.
void add_levels(Report& report, const std::vector<LevelSummary>& levels, bool has_siblings) {
  Json list = Json::array();
  report.text += "level  clusters  mean vertices  mean radius  mean siblings     bytes\n";
  for (const LevelSummary& level : levels) {
    const bool is_counted = has_siblings || level.level == 0;
    list.push_back({{"level", level.level},
                    {"clusters", level.clusters},
                    {"mean_vertices", level.mean_vertices},
                    {"mean_radius", level.mean_radius},
                    {"mean_siblings", is_counted ? Json(level.mean_siblings) : Json()},
                    {"bytes", level.bytes}});
    report.text +=
        fmt::format("{:5}  {:8}  {:13.2f}  {:11.4g}  {:>13}  {:8}\n", level.level, level.clusters, level.mean_vertices,
                    level.mean_radius, is_counted ? fmt::format("{:.2f}", level.mean_siblings) : "-", level.bytes);
  }
  report.document["levels"] = std::move(list);
}

Report report_of(const Index& index) {
  const IndexBytes bytes = index.bytes();
  Report report{{{"bytes", bytes.total()}},
                fmt::format("exact index: {}\n", bytes_text(static_cast<double>(bytes.total())))};
  for (const auto& [part, size] : {std::pair{"positions", bytes.positions},
                                   {"permutation", bytes.permutation},
                                   {"graph", bytes.graph},
                                   {"tree", bytes.tree}}) {
    report.document[part] = size;
    report.text += fmt::format("{:<11}  {:9}\n", part, size);
  }
  add_levels(report, index.levels(), false);
  return report;
}

Report report_of(const paper::Index& index) {
  const std::size_t bytes = index.bytes().total();
  Report report{{{"bytes", bytes}}, fmt::format("index of the paper: {}\n", bytes_text(static_cast<double>(bytes)))};
  add_levels(report, index.levels(), true);
  return report;
}

std::string_view format_name(io::Format format) {
  switch (format) {
    case io::Format::Ply: return "PLY";
    case io::Format::Obj: return "OBJ";
    case io::Format::Off: return "OFF";
    case io::Format::Stl: return "STL";
    case io::Format::Vtk: return "VTK";
    case io::Format::FreeSurfer: return "FreeSurfer";
    case io::Format::Other: break;
  }
  return "other";
}

std::string to_text(const std::map<std::size_t, std::size_t>& polygon_degrees) {
  std::vector<std::string> parts;
  parts.reserve(polygon_degrees.size());
  for (const auto& [corners, faces] : polygon_degrees) parts.push_back(fmt::format("{} of {}", faces, corners));
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string to_text(const std::optional<Box>& bounds) {
  if (!bounds) return "none";
  return fmt::format("{:g} to {:g}", fmt::join(bounds->min, " "), fmt::join(bounds->max, " "));
}

/// O(#V log #V + #corners log #corners).
Report report_of(Input& input, std::size_t components, std::size_t repeated) {
  const io::Mesh& mesh = *input.mesh();
  const MeshView view = mesh.view();
  const std::size_t welded = input.welding().count();
  const std::map<std::size_t, std::size_t> by_corners = polygon_degrees(view.faces);
  const EdgeCounts edges = count_edges(view.faces);
  const double mean_edge = mean_edge_length(input.graph());
  const std::optional<Box> box = bounds(view.positions);
  Json degrees = Json::object();
  for (const auto& [corners, faces] : by_corners) degrees[std::to_string(corners)] = faces;
  Json warnings = Json::array();
  for (const auto& [what, count, first_place] : mesh.warnings) {
    warnings.push_back({{"what", what}, {"count", count}, {"first_place", first_place}});
  }
  Report report{{{"mesh", input.name()}, {"format", format_name(mesh.format)}}, ""};
  report.add_line("mesh", fmt::format("{} ({})", printable_name(input.name()), format_name(mesh.format)));
  report.add("vertices", "vertices", view.positions.size());
  report.add("faces", "faces", view.faces.size());
  report.add("polygon_degrees", "corners per face", degrees, to_text(by_corners));
  report.add("edges", "edges", edges.all);
  report.add("components", "components", components);
  report.add("isolated_vertices", "isolated vertices", count_isolated(view) - welded);
  report.add("border_edges", "border edges", edges.border);
  report.add("nonmanifold_edges", "non-manifold edges", edges.nonmanifold);
  report.add("mean_edge_length", "mean edge length", mean_edge, fmt::format("{:.4g}", mean_edge));
  report.add("repeated_corners", "repeated corners", repeated_corners(view.faces));
  report.add("repeated_positions", "repeated positions", repeated);
  report.document["welded_vertices"] = welded;
  if (welded > 0) report.add_line("welded vertices", std::to_string(welded));
  report.add("bounding_box", "bounding box", box ? Json{{"min", box->min}, {"max", box->max}} : Json(), to_text(box));
  report.document["warnings"] = std::move(warnings);
  return report;
}

Report report_of(const std::string& name, const IndexHeader& header) {
  const std::string_view precision = header.is_double ? "double" : "float";
  const std::string_view kind = kind_name(header.kind);
  Report report{{{"index", name}, {"format", header.format}, {"kind", kind}}, ""};
  report.add_line("index", fmt::format("{} ({}, format {})", printable_name(name), kind, header.format));
  report.add("vertices", "vertices", header.vertices);
  report.add("precision", "coordinates", precision, precision);
  report.add("fingerprint", "mesh", to_text(header.mesh), to_text(header.mesh));
  return report;
}

std::size_t components_if_welded(const io::Mesh& mesh, double eps) {
  const io::WeldedMesh welded = io::weld(mesh.view(), eps);
  const Adjacency graph = adjacency(welded.view());
  return count_components(welded.view(), graph.view());
}

/// Names welding if repeated positions split components or, of a mesh of nearly as many components as faces, positions
/// that differ by rounding.
void note_split_components(Input& input, std::size_t components, std::size_t repeated) {
  if (components < 2 || input.welding().count() > 0) return;
  std::size_t fewest = components;
  std::string_view positions;
  std::string option;
  const auto attempt = [&](std::string_view positions_of_attempt, const std::string& eps) {
    const std::size_t joined = components_if_welded(*input.mesh(), eps.empty() ? 0 : eps_of(eps));
    if (joined >= fewest) return;
    fewest = joined;
    positions = positions_of_attempt;
    option = eps.empty() ? "--weld" : "--weld=" + eps;
  };
  if (repeated > 0) attempt("equal", "");
  if (10 * fewest >= 9 * input.mesh()->view().faces.size()) {
    attempt("nearly equal", rounding_eps(mean_edge_length(input.graph())));
  }
  if (fewest == components) return;
  print_error("note: ", fmt::format("vertices at {} positions split the mesh into {} components; {} joins them into {}",
                                    positions, components, option, fewest));
}

/// With --index, also builds both indexes.
void info_of_mesh(const InfoCommand& options, Input& input) {
  const std::size_t components = count_components(input.mesh()->view(), input.graph().adjacency);
  const std::size_t repeated = repeated_positions(*input.mesh());
  note_split_components(input, components, repeated);
  Report report = report_of(input, components, repeated);
  if (options.index) {
    const Report exact = report_of(input.exact_index());
    const Report paper = report_of(input.paper_index());
    report.document["index"] = {{"exact", exact.document}, {"paper", paper.document}};
    report.text += '\n' + exact.text + '\n' + paper.text;
  }
  print_result(options.json, report.document, report.text);
}

void info(const InfoCommand& options) {
  Input input(options.reading);
  if (input.mesh() != nullptr) return info_of_mesh(options, input);
  if (options.index) wrong_option("--index: {} is an index, expected a mesh", printable_name(input.name()));
  const IndexHeader& header = input.header();
  Report report = report_of(input.name(), header);
  const Report index =
      header.kind == IndexKind::Paper ? report_of(input.paper_index()) : report_of(input.exact_index());
  report.document.update(index.document);
  print_result(options.json, report.document, report.text + '\n' + index.text);
}

}  // namespace

void add_info(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "info",
                  "Print the size, components, border and defects of a mesh, or the size and levels of an index", info);
  add_file(command, options.reading);
  command.add_flag("--index", options.index, "for a mesh: also build both indexes and print their sizes and levels");
  add_json(command, options.json);
}

}  // namespace meshhood::cli
