// SPDX-License-Identifier: MIT
// meshhood build: an index in a file, to be asked for weeks.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "building.h"
#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "io/index_io.h"
#include "output.h"
#include "question.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string mesh;
  unsigned threads = kAllThreads;
  bool json = false;
  std::string output;
};

/// What was saved, in figures.
struct Summary {
  std::size_t vertices;
  std::size_t leaves;
  std::uintmax_t bytes;  ///< of the file; 0 for what is no ordinary one
  double seconds;        ///< to build it
};

void save(const std::string& file, const Index& index) {
  const Interrupt interrupt;  // Ctrl-C waits, for it would leave a part of the file beside it
  io::save(file, index);
}

Summary build_and_save(const Options& options) {
  const io::Mesh mesh = read_mesh(options.mesh);
  const auto start = std::chrono::steady_clock::now();
  const Index index = build_exact_index(mesh.view(), options.threads);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  save(options.output, index);
  std::error_code not_ordinary;
  const std::uintmax_t bytes = std::filesystem::file_size(options.output, not_ordinary);
  const std::vector<LevelSummary> levels = index.levels();
  return {.vertices = index.vertex_count(),
          .leaves = levels.empty() ? 0 : levels.front().clusters,
          .bytes = not_ordinary ? 0 : bytes,
          .seconds = elapsed.count()};
}

Json to_json(const Options& options, const Summary& summary) {
  return {{"output", options.output},
          {"vertices", summary.vertices},
          {"leaves", summary.leaves},
          {"bytes", summary.bytes},
          {"seconds", summary.seconds}};
}

std::string to_text(const Options& options, const Summary& summary) {
  return fmt::format("{}: {} vertices, {} leaves, {} bytes, built in {:.3f} s\n", printable(options.output),
                     summary.vertices, summary.leaves, summary.bytes, summary.seconds);
}

void build(const Options& options) {
  refuse_same_file(options.mesh, options.output);
  const Summary summary = build_and_save(options);
  options.json ? print_json(to_json(options, summary)) : print_text(to_text(options, summary));
}

}  // namespace

void add_build(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("build", "Build the index of a mesh, once, and save it");
  add_mesh(*command, options->mesh);
  add_threads(*command, options->threads);
  command->add_option("-o,--output", options->output, "the index file to write")->type_name("FILE")->required();
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { build(*options); });
}

}  // namespace meshhood::cli
