// SPDX-License-Identifier: MIT
// meshhood build: builds an index and saves it.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/index_io.h"
#include "options.h"
#include "output.h"
#include "system.h"
#include "task.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

struct BuildCommand {
  Reading mesh;
  std::string index = "exact";
  std::string cut;
  bool faces = false;
  unsigned threads = kAllProcessors;
  bool json = false;
  std::string output;
};

using BuiltIndex = std::variant<Index, paper::Index>;

/// Of a `MeshView` or a `GraphView`.
template <class Mesh>
BuiltIndex build_index(const BuildCommand& options, const Mesh& mesh) {
  if (options.index == "paper") return build_paper_index(mesh);
  return build_exact_index(mesh, options.threads);
}

void save(const std::string& file, const BuiltIndex& built, const SaveOptions& settings) {
  Task task("writing " + file);
  const Run run{.progress = task.progress()};
  if (const auto* index = std::get_if<Index>(&built)) return io::save(path_of(file), *index, settings, run);
  io::save(path_of(file), std::get<paper::Index>(built), run);
}

void print(const BuildCommand& options, const BuiltIndex& built, double seconds) {
  std::error_code not_regular;
  const std::uintmax_t size = std::filesystem::file_size(path_of(options.output), not_regular);
  const std::uintmax_t bytes = not_regular ? 0 : size;  // 0 for a pipe or a device
  const std::size_t vertices = std::visit([](const auto& index) { return index.vertex_count(); }, built);
  const std::vector<LevelSummary> levels = std::visit([](const auto& index) { return index.levels(); }, built);
  const std::size_t lowest = levels.empty() ? 0 : levels.front().clusters;
  const std::string_view clusters = options.index == "paper" ? "clusters" : "leaves";
  print_result(options.json,
               {{"output", options.output},
                {"index", options.index},
                {"vertices", vertices},
                {clusters, lowest},
                {"bytes", bytes},
                {"seconds", seconds}},
               fmt::format("{}: {} vertices, {} {}, {}, built in {:.3f} s\n", printable_name(options.output), vertices,
                           lowest, clusters, bytes_text(static_cast<double>(bytes)), seconds));
}

/// The graph of the mesh without the edges that `file` lists.
Adjacency cut_graph(const MeshView& mesh, const std::string& file, const Welding& welding) {
  const Adjacency whole = adjacency(mesh);
  std::vector<VertexId> edges = read_vertex_list(file, whole.view().size(), 2);
  for (VertexId& v : edges) v = welding.kept(v);
  try {
    return cut_edges(whole.view(), edges);
  } catch (const Error& error) {
    raise(error.code(), fmt::format("{}: {}", printable_name(file), error.what()));
  }
}

void build(const BuildCommand& options) {
  if (options.faces && options.index == "paper") {
    wrong_option("--faces: the index of the paper is saved without faces; expected --index exact");
  }
  check_outputs();
  io::Mesh mesh = read_mesh(options.mesh, options.threads);
  io::refuse_walls(mesh, printable_name(options.mesh.file));
  const Welding welding(mesh, options.mesh.weld, options.mesh.file);
  const std::optional<Adjacency> rest =
      options.cut.empty() ? std::nullopt : std::optional(cut_graph(mesh.view(), options.cut, welding));
  const auto start = std::chrono::steady_clock::now();
  const BuiltIndex index =
      rest ? build_index(options, GraphView{mesh.view().positions, rest->view()}) : build_index(options, mesh.view());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  save(options.output, index, {.faces = options.faces ? std::optional(mesh.view().faces) : std::nullopt});
  print(options, index, elapsed.count());
}

}  // namespace

void add_build(CLI::App& program) {
  const auto [command, options] = add_command(program, "build", "Build the index of a mesh and save it", build);
  add_mesh(command, options.mesh);
  add_choice(command, "--index", "exact: for exact answers; paper: the index of the paper", {"exact", "paper"},
             options.index);
  add_file_option(command, "--cut", "a list of edges that no search crosses: on each line the two vertices of one",
                  options.cut);
  command.add_flag("--faces", options.faces,
                   "save the faces with the index, for the commands that need them, such as curvature");
  add_threads(command, options.threads);
  add_output(command, ".mhi", "index file to write", options.output)->required();
  add_json(command, options.json);
}

}  // namespace meshhood::cli
