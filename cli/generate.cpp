// SPDX-License-Identifier: MIT
// meshhood generate: a mesh made by formula.
#include <cstdint>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "interrupt.h"
#include "io/mesh_io.h"
#include "output.h"
#include "query_arguments.h"
#include "shapes/shapes.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string kind;
  std::uint64_t vertices = 0;
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
  json ? print_json(document) : print_text(text);
}

const shapes::Kind& find(const std::string& name) {
  const shapes::Kind* kind = shapes::find_kind(name);
  if (kind == nullptr) {
    raise(ErrorCode::InvalidOption, "there is no shape '" + name + "'; meshhood generate --list names them all");
  }
  return *kind;
}

void save(const std::string& file, const MeshView& mesh) {
  const Interrupt interrupt;  // outlives the file that it is to leave no trace of
  io::write_ply(file, mesh, {.progress = interrupt.watch()});
}

void generate(const Options& options) {
  if (options.list) return list(options.json);
  if (options.kind.empty()) raise(ErrorCode::InvalidOption, "generate: KIND is missing; --list names them all");
  if (options.output.empty()) raise(ErrorCode::InvalidOption, "generate: --output is missing");
  const shapes::Shape shape = find(options.kind).make(options.vertices);
  const MeshView mesh = shape.view();
  save(options.output, mesh);
  if (options.json) {
    print_json(Json{{"kind", options.kind},
                    {"vertices", mesh.positions.size()},
                    {"faces", mesh.faces.size()},
                    {"output", options.output}});
  } else {
    print_text(fmt::format("{}: {} vertices, {} faces\n", printable(options.output), mesh.positions.size(),
                           mesh.faces.size()));
  }
}

}  // namespace

void add_generate(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("generate", "A mesh with a known trap, for benchmarks and tests");
  command->add_option("KIND", options->kind, "which; see --list")->type_name("");
  command->add_option("--vertices", options->vertices, "how many, exactly or within 5 %")
      ->transform(whole_number())
      ->type_name("NUMBER")
      ->default_val(10000);
  add_output(*command, options->output, "the PLY file to write");
  command->add_flag("--list", options->list, "every kind and its trap");
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { generate(*options); });
}

}  // namespace meshhood::cli
