// SPDX-License-Identifier: MIT
// meshhood info: what a mesh is like.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "input.h"
#include "methods.h"
#include "output.h"
#include "question.h"
#include "statistics.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string file;
  bool index = false;
  bool json = false;
};

std::string_view format_name(io::Format format) {
  switch (format) {
    case io::Format::Ply: return "PLY";
    case io::Format::Obj: return "OBJ";
    case io::Format::Off: return "OFF";
    case io::Format::Stl: return "STL";
  }
  return "?";
}

Json to_json(const io::Warning& warning) {
  return {{"what", warning.what}, {"count", warning.count}, {"first_place", warning.first_place}};
}

Json to_json(const paper::Index& index) {
  Json levels = Json::array();
  for (const paper::LevelSummary& level : index.levels()) {
    levels.push_back({{"level", level.level},
                      {"clusters", level.clusters},
                      {"mean_vertices", level.mean_vertices},
                      {"mean_radius", level.mean_radius},
                      {"mean_siblings", level.mean_siblings},
                      {"bytes", level.bytes}});
  }
  return {{"bytes", index.bytes()}, {"levels", levels}};
}

Json to_json(const IndexBytes& bytes) {
  return {{"bytes", bytes.total()},
          {"positions", bytes.positions},
          {"permutation", bytes.permutation},
          {"graph", bytes.graph},
          {"tree", bytes.tree}};
}

Json to_json(const Input& input, const Statistics& s) {
  Json degrees = Json::object();
  for (const auto& [corners, faces] : s.polygon_degrees) degrees[std::to_string(corners)] = faces;
  Json warnings = Json::array();
  for (const io::Warning& warning : input.mesh.warnings) warnings.push_back(to_json(warning));
  return {{"mesh", input.name},
          {"format", format_name(input.mesh.format)},
          {"vertices", s.vertices},
          {"faces", s.faces},
          {"polygon_degrees", degrees},
          {"edges", s.edges},
          {"components", s.components},
          {"isolated_vertices", s.isolated_vertices},
          {"boundary_edges", s.boundary_edges},
          {"nonmanifold_edges", s.nonmanifold_edges},
          {"average_edge", s.average_edge},
          {"repeated_positions", s.repeated_positions},
          {"bounding_box", s.bounds ? Json{{"min", s.bounds->min}, {"max", s.bounds->max}} : Json()},
          {"warnings", warnings}};
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

std::string to_text(const Input& input, const Statistics& s) {
  std::string text;
  const auto row = [&](std::string_view name, const std::string& value) {
    text += fmt::format("{:<19} {}\n", name, value);
  };
  row("mesh", fmt::format("{} ({})", printable(input.name), format_name(input.mesh.format)));
  row("vertices", std::to_string(s.vertices));
  row("faces", std::to_string(s.faces));
  row("corners of a face", to_text(s.polygon_degrees));
  row("edges", std::to_string(s.edges));
  row("components", std::to_string(s.components));
  row("isolated vertices", std::to_string(s.isolated_vertices));
  row("boundary edges", std::to_string(s.boundary_edges));
  row("non-manifold edges", std::to_string(s.nonmanifold_edges));
  row("average edge", fmt::format("{:.4g}", s.average_edge));
  row("repeated positions", std::to_string(s.repeated_positions));
  row("bounding box", to_text(s.bounds));
  return text;
}

std::string to_text(const IndexBytes& bytes) {
  std::string text = fmt::format("\nexact index: {} bytes\n", bytes.total());
  const auto row = [&](std::string_view part, std::size_t size) { text += fmt::format("{:<11}  {:9}\n", part, size); };
  row("positions", bytes.positions);
  row("permutation", bytes.permutation);
  row("graph", bytes.graph);
  row("tree", bytes.tree);
  return text;
}

std::string to_text(const paper::Index& index) {
  std::string text = fmt::format("\nindex of the paper: {} bytes\n", index.bytes());
  text += "level  clusters  mean vertices  mean radius  mean siblings     bytes\n";
  for (const paper::LevelSummary& level : index.levels()) {
    text += fmt::format("{:5}  {:8}  {:13.2f}  {:11.4g}  {:13.2f}  {:8}\n", level.level, level.clusters,
                        level.mean_vertices, level.mean_radius, level.mean_siblings, level.bytes);
  }
  return text;
}

void info(const Options& options) {
  const Input input = read_input(options.file);
  const Statistics summary = statistics(input.view(), input.adjacency.view());
  Json document = to_json(input, summary);
  std::string text = to_text(input, summary);
  if (options.index) {
    const IndexBytes exact = build_exact_index(input.view(), kAllThreads).bytes();
    const paper::Index paper = build_paper_index(input.view());
    document["index"] = {{"exact", to_json(exact)}, {"paper", to_json(paper)}};
    text += to_text(exact) + to_text(paper);
  }
  options.json ? print_json(document) : print_text(text);
}

}  // namespace

void add_info(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("info", "What a mesh is like: its size, components, borders and flaws");
  add_mesh_file(*command, options->file);
  command->add_flag("--index", options->index,
                    "also build the exact index and that of the paper, and list their parts");
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { info(*options); });
}

}  // namespace meshhood::cli
