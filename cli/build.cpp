// SPDX-License-Identifier: MIT
// meshhood build: an index in a file, to be asked for weeks.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
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
#include "query_arguments.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string mesh;
  std::string clustering = "default";
  unsigned threads = kAllThreads;
  bool json = false;
  std::string output;
};

/// What was saved, in figures.
struct Summary {
  std::size_t vertices;
  std::size_t clusters;  ///< on the lowest level
  std::uintmax_t bytes;  ///< of the file; 0 for what is no ordinary one
  double seconds;        ///< to build it
};

template <class AnyIndex>
void save(const std::string& file, const AnyIndex& index) {
  const Interrupt interrupt;  // outlives the file that it is to leave no trace of
  io::save(file, index, {.progress = interrupt.watch()});
}

template <class Build>
Summary build_and_save(const std::string& file, Build&& build) {
  const auto start = std::chrono::steady_clock::now();
  const auto index = build();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  save(file, index);
  std::error_code not_ordinary;
  const std::uintmax_t bytes = std::filesystem::file_size(file, not_ordinary);
  const std::vector<LevelSummary> levels = index.levels();
  return {.vertices = index.vertex_count(),
          .clusters = levels.empty() ? 0 : levels.front().clusters,
          .bytes = not_ordinary ? 0 : bytes,
          .seconds = elapsed.count()};
}

/// What the clusters of the lowest level are called.
std::string_view clusters_name(const Options& options) { return options.clustering == "paper" ? "clusters" : "leaves"; }

Json to_json(const Options& options, const Summary& summary) {
  return {{"output", options.output},     {"clustering", options.clustering},
          {"vertices", summary.vertices}, {clusters_name(options), summary.clusters},
          {"bytes", summary.bytes},       {"seconds", summary.seconds}};
}

std::string to_text(const Options& options, const Summary& summary) {
  return fmt::format("{}: {} vertices, {} {}, {} bytes, built in {:.3f} s\n", printable(options.output),
                     summary.vertices, summary.clusters, clusters_name(options), summary.bytes, summary.seconds);
}

void build(const Options& options) {
  refuse_same_file(options.mesh, options.output);
  const io::Mesh mesh = read_mesh(options.mesh);
  const Summary summary =
      options.clustering == "paper"
          ? build_and_save(options.output, [&] { return build_paper_index(mesh.view()); })
          : build_and_save(options.output, [&] { return build_exact_index(mesh.view(), options.threads); });
  options.json ? print_json(to_json(options, summary)) : print_text(to_text(options, summary));
}

}  // namespace

void add_build(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("build", "Build the index of a mesh, once, and save it");
  add_mesh(*command, options->mesh);
  command->add_option("--clustering", options->clustering, "default: for exact answers; paper: for those of the paper")
      ->check(CLI::IsMember({"default", "paper"}))
      ->type_name("")
      ->capture_default_str();
  add_threads(*command, options->threads);
  add_output(*command, options->output, "the index file to write")->required();
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { build(*options); });
}

}  // namespace meshhood::cli
