// SPDX-License-Identifier: MIT
// meshhood check: verifies an index file, alone or against a mesh.
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "options.h"
#include "output.h"

namespace meshhood::cli {
namespace {

struct CheckCommand {
  std::string index;
  Reading mesh;  ///< the name of its file is empty if it is not given
  bool json = false;
};

[[noreturn]] void refuse(const CheckCommand& options, const std::string& message) {
  raise(ErrorCode::MalformedIndex, printable_name(options.index) + ": " + message);
}

void expect_built_from(const CheckCommand& options, const IndexHeader& header, const Fingerprint& mesh,
                       const std::string& name) {
  if (header.mesh == mesh) return;
  refuse(options,
         fmt::format("built from mesh {}, but {} is {}", to_text(header.mesh), printable_name(name), to_text(mesh)));
}

void expect_none(const CheckCommand& options, const std::vector<std::string>& violations) {
  if (violations.empty()) return;
  const std::string more = violations.size() > 1 ? fmt::format(" (and {} similar)", violations.size() - 1) : "";
  refuse(options, violations.front() + more);
}

template <class AnyIndex>
void check_against_mesh(const CheckCommand& options, const IndexHeader& header, const AnyIndex& index) {
  io::Mesh mesh = read_mesh(options.mesh);
  static_cast<void>(Welding(mesh, options.mesh.weld, options.mesh.file));
  expect_built_from(options, header, fingerprint(mesh.view()), options.mesh.file);
  expect_none(options, index.check(mesh.view()));
}

/// The exact index contains the graph, so it can be compared with the fingerprint in its header.
void check_alone(const CheckCommand& options, const IndexHeader& header, const Index& index) {
  const GraphData graph = extract_graph(index);
  expect_built_from(options, header, fingerprint(graph.view()), "the mesh in the index");
  expect_none(options, index.check(graph.view()));
}

/// Loading has verified everything that can be verified.
void check_alone(const CheckCommand& /*options*/, const IndexHeader& /*header*/, const paper::Index& /*index*/) {}

void print(const CheckCommand& options, const IndexHeader& header) {
  const auto row = [](std::string_view name, const std::string& value) {
    return fmt::format("{:<10} {}\n", name, value);
  };
  const std::string& mesh = options.mesh.file;
  const Json document{{"index", options.index},
                      {"format", header.format},
                      {"kind", kind_name(header.kind)},
                      {"vertices", header.vertices},
                      {"bytes", header.bytes},
                      {"fingerprint", to_text(header.mesh)},
                      {"mesh", mesh.empty() ? Json() : Json(mesh)}};
  const std::string index =
      fmt::format("{} ({}, format {}, {} vertices, {})", printable_name(options.index), kind_name(header.kind),
                  header.format, header.vertices, bytes_text(static_cast<double>(header.bytes)));
  const std::string compared = mesh.empty() ? "not compared; use --mesh" : "the same as " + printable_name(mesh);
  print_result(options.json, document,
               row("index", index) + row("checksums", "correct") + row("structure", "correct") +
                   row("mesh", fmt::format("{} ({})", to_text(header.mesh), compared)));
}

void check(const CheckCommand& options) {
  const io::LoadedIndex loaded = load_index(options.index);
  std::visit(
      [&](const auto& index) {
        options.mesh.file.empty() ? check_alone(options, loaded.header, index)
                                  : check_against_mesh(options, loaded.header, index);
      },
      loaded.index);
  print(options, loaded.header);
}

}  // namespace

void add_check(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "check", "Verify an index file, alone or against the mesh", check);
  add_file_option(command, "INDEX", "index file (made by meshhood build)", options.index)->required()->type_name("");
  CLI::Option* mesh =
      add_file_option(command, "--mesh", "also verify that the index was built from this mesh", options.mesh.file);
  for (CLI::Option* option : add_reading(command, options.mesh)) option->needs(mesh);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
