// SPDX-License-Identifier: MIT
// meshhood check: whether an index file is whole, and that of a mesh.
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "index_parts.h"
#include "input.h"
#include "io/index_io.h"
#include "output.h"
#include "query_arguments.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string index;
  std::string mesh;  ///< empty where none is given
  bool json = false;
};

[[noreturn]] void refuse(const Options& options, const std::string& message) {
  raise(ErrorCode::MalformedIndex, printable(options.index) + ": " + message);
}

void expect_built_from(const Options& options, const IndexHeader& header, const Fingerprint& mesh,
                       const std::string& name) {
  if (header.mesh == mesh) return;
  refuse(options, fmt::format("built from mesh {}, but {} is {}", to_text(header.mesh), name, to_text(mesh)));
}

void expect_none(const Options& options, const std::vector<std::string>& violations) {
  if (violations.empty()) return;
  const std::string more =
      violations.size() > 1 ? fmt::format(" (and {} more of the kind)", violations.size() - 1) : "";
  refuse(options, violations.front() + more);
}

template <class AnyIndex>
void check_against(const io::Mesh& mesh, const Options& options, const IndexHeader& header, const AnyIndex& index) {
  expect_built_from(options, header, fingerprint(mesh.view()), options.mesh);
  expect_none(options, index.check(mesh.view()));
}

/// It keeps the graph, so that even alone it can be compared with what it says to be built from.
void check_alone(const Options& options, const IndexHeader& header, const Index& index) {
  const GraphData graph = meshhood::extract_graph(index);
  expect_built_from(options, header, fingerprint(graph.view()), "what it holds");
  expect_none(options, index.check(graph.view()));
}

/// Loading has verified all there is.
void check_alone(const Options& /*options*/, const IndexHeader& /*header*/, const paper::Index& /*index*/) {}

template <class AnyIndex>
void check_index(const Options& options, const IndexHeader& header, const AnyIndex& index) {
  if (options.mesh.empty()) {
    check_alone(options, header, index);
  } else {
    check_against(read_mesh(options.mesh), options, header, index);
  }
}

Json to_json(const Options& options, const IndexHeader& header) {
  return {{"index", options.index},
          {"format", header.format},
          {"kind", kind_name(header.kind)},
          {"vertices", header.vertices},
          {"bytes", header.bytes},
          {"fingerprint", to_text(header.mesh)},
          {"mesh", options.mesh.empty() ? Json() : Json(options.mesh)}};
}

std::string to_text(const Options& options, const IndexHeader& header) {
  Rows rows(10);
  rows.add("index", fmt::format("{} ({}, format {}, {} vertices, {} bytes)", printable(options.index),
                                kind_name(header.kind), header.format, header.vertices, header.bytes));
  rows.add("checksums", "fit");
  rows.add("structure", "holds");
  const std::string mesh = options.mesh.empty() ? "not compared; --mesh names it" : printable(options.mesh) + " fits";
  rows.add("mesh", fmt::format("{} ({})", to_text(header.mesh), mesh));
  return rows.text();
}

void check(const Options& options) {
  const IndexHeader header = io::read_header(options.index);
  if (header.kind == IndexKind::Paper) {
    check_index(options, header, load_paper_index(options.index));
  } else {
    check_index(options, header, load_exact_index(options.index));
  }
  options.json ? print_json(to_json(options, header)) : print_text(to_text(options, header));
}

}  // namespace

void add_check(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("check", "Whether an index file is whole, and that of a mesh");
  command->add_option("INDEX", options->index, "index file (meshhood build)")
      ->required()
      ->check(file_name())
      ->type_name("");
  command->add_option("--mesh", options->mesh, "the mesh it is said to be built from")
      ->check(file_name())
      ->type_name("FILE");
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { check(*options); });
}

}  // namespace meshhood::cli
