// SPDX-License-Identifier: MIT
// meshhood generate: writes a synthetic mesh.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "shapes/shapes.h"
#include "system.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct GenerateCommand {
  std::string kind;
  std::uint64_t vertices = 10000;
  std::string output;
  bool list = false;
  bool json = false;
};

void list(bool json) {
  Json document = Json::array();
  std::string text;
  for (const shapes::Kind& kind : shapes::kinds()) {
    document.push_back({{"kind", kind.name}, {"trap", kind.trap}, {"minimum_vertices", kind.minimum}});
    text += fmt::format("{:<9} {}\n", kind.name, kind.trap);
  }
  print_result(json, document, text);
}

const shapes::Kind& find(const std::string& name) {
  if (const shapes::Kind* kind = shapes::find_kind(name)) return *kind;
  std::vector<std::string> names;
  for (const shapes::Kind& kind : shapes::kinds()) names.emplace_back(kind.name);
  raise(ErrorCode::InvalidOption,
        fmt::format("unknown shape '{}'; meshhood generate --list prints all{}", name, suggestion(name, names)));
}

void save(const std::string& file, const MeshView& mesh) {
  Task task("writing " + file);
  io::write_ply(path_of(file), mesh, {.progress = task.progress()});
}

void generate(const GenerateCommand& options) {
  if (options.list) return list(options.json);
  if (options.kind.empty()) raise(ErrorCode::InvalidOption, "generate: KIND is missing; --list prints all");
  if (options.output.empty()) raise(ErrorCode::InvalidOption, "generate: --output is missing");
  check_outputs();
  const shapes::Shape shape = find(options.kind).make(options.vertices);
  const MeshView mesh = shape.view();
  save(options.output, mesh);
  print_result(options.json,
               {{"kind", options.kind},
                {"vertices", mesh.positions.size()},
                {"faces", mesh.faces.size()},
                {"output", options.output}},
               fmt::format("{}: {} vertices, {} faces\n", printable_name(options.output), mesh.positions.size(),
                           mesh.faces.size()));
}

}  // namespace

void add_generate(CLI::App& program) {
  auto options = std::make_shared<GenerateCommand>();
  CLI::App* command = program.add_subcommand("generate", "Write a synthetic mesh for benchmarks and tests");
  command->add_option("KIND", options->kind, "kind of shape; see --list")->type_name("");
  add_number(*command, "--vertices", "number of vertices, exact or within 5 %", options->vertices)
      ->capture_default_str();
  add_output(*command, ".ply", "mesh file to write", options->output);
  command->add_flag("--list", options->list, "print all kinds and what is difficult about them")
      ->excludes("KIND", "--vertices", "--output");
  add_json(*command, options->json);
  command->callback([options] { generate(*options); });
}

}  // namespace meshhood::cli
