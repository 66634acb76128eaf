// SPDX-License-Identifier: MIT
// meshhood generate: writes a synthetic mesh.
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "mesh_file.h"
#include "options.h"
#include "output.h"
#include "shapes/shapes.h"

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
  wrong_option("unknown shape '{}'; meshhood generate --list prints all{}", name, suggestion(name, names));
}

void generate(const GenerateCommand& options) {
  if (options.list) return list(options.json);
  if (options.kind.empty()) wrong_option("generate: KIND is missing; --list prints all");
  if (options.output.empty()) wrong_option("generate: --output is missing");
  check_outputs();
  const shapes::Shape shape = find(options.kind).make(options.vertices);
  const MeshView mesh = shape.view();
  write_ply(options.output, mesh);
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
  const auto [command, options] =
      add_command(program, "generate", "Write a synthetic mesh for benchmarks and tests", generate);
  command.add_option("KIND", options.kind, "kind of shape; see --list")->type_name("");
  add_number(command, "--vertices", "number of vertices, exact or within 5 %", options.vertices)->capture_default_str();
  add_output(command, ".ply", "mesh file to write", options.output);
  command.add_flag("--list", options.list, "print all kinds and what is difficult about them")
      ->excludes("KIND", "--vertices", "--output");
  add_json(command, options.json);
}

}  // namespace meshhood::cli
