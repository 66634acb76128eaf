// SPDX-License-Identifier: MIT
// meshhood partition: cuts a mesh into parts with a halo, in bounded memory.
#include "parts/partition.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "io/number.h"
#include "io/text.h"
#include "options.h"
#include "output.h"
#include "system.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct PartitionCommand {
  Reading mesh;
  std::string faces;  ///< a file of faces; empty if `mesh` has them
  std::uint64_t parts = 0;
  std::uint64_t vertices_per_part = 0;
  std::string halo;
  std::string unit = "mesh";
  std::uint64_t memory = 0;
  unsigned threads = kAllProcessors;
  bool no_resume = false;
  bool json = false;
  std::string output;
};

/// Accepts digits and a unit, with blanks around each, as `partition` of Python does, and makes them a number of bytes.
std::string parse_size(std::string& text) {
  constexpr Names<std::uint64_t, 9> kUnits{{{"", 1},
                                            {"k", 1'000},
                                            {"m", 1'000'000},
                                            {"g", 1'000'000'000},
                                            {"t", 1'000'000'000'000},
                                            {"ki", std::uint64_t{1} << 10},
                                            {"mi", std::uint64_t{1} << 20},
                                            {"gi", std::uint64_t{1} << 30},
                                            {"ti", std::uint64_t{1} << 40}}};
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  const std::optional<std::uint64_t> number = io::parse_count(text.substr(begin, end - begin));
  std::string unit = io::lower_case(text.substr(end));
  unit.erase(0, unit.find_first_not_of(' '));
  unit.erase(unit.find_last_not_of(' ') + 1);
  if (unit.ends_with('b')) unit.pop_back();
  const auto known = std::ranges::find(kUnits, unit, [](const auto& named) { return named.first; });
  if (!number || known == kUnits.end() || *number > std::numeric_limits<std::uint64_t>::max() / known->second) {
    return fmt::format("'{}', expected a number of bytes or a text such as '4GiB'", text);
  }
  text = std::to_string(*number * known->second);
  return {};
}

std::unique_ptr<parts::ChunkedMesh> open(const PartitionCommand& options, const Progress& progress) {
  const std::filesystem::path file = path_of(options.mesh.file);
  if (!options.faces.empty()) return parts::open_arrays(file, path_of(options.faces));
  const std::uint64_t most = options.memory / parts::kMemoryPerByte;
  if (options.mesh.weld.empty() && options.mesh.precision.empty()) {
    try {
      return parts::open_mesh(file, most, progress);
    } catch (const Error& refusal) {
      // Such a file may be for another reader, which reads it from the beginning.
      if (refusal.code() != ErrorCode::UnsupportedFormat || !std::filesystem::is_regular_file(file)) throw;
    }
  }
  io::Mesh mesh = read_mesh(options.mesh, options.threads, most);
  mesh.warnings.clear();  // which are printed
  static_cast<void>(Welding(mesh, options.mesh.weld, options.mesh.file));
  return parts::chunked(std::move(mesh), printable_name(options.mesh.file));
}

parts::PartitionResult run(const PartitionCommand& options) {
  Task task("partitioning " + options.mesh.file);
  return partition(*open(options, task.progress()), path_of(options.output),
                   {.parts = options.parts,
                    .vertices_per_part = options.vertices_per_part,
                    .halo = parse_radius("halo", options.halo),
                    .halo_in_edges = options.unit == "edge",
                    .memory = options.memory,
                    .resume = !options.no_resume},
                   {.threads = options.threads, .progress = task.progress()});
}

void partition_mesh(const PartitionCommand& options) {
  const parts::PartitionResult result = run(options);
  for (const std::string& warning : result.warnings) print_error("warning: ", warning);
  const parts::Plan& plan = result.manifest.plan;
  std::uint64_t vertices = 0;  // with the halos
  std::uint64_t largest = 0;   // of a part
  std::uint64_t bytes = 0;
  for (const parts::Part& part : result.manifest.parts) {
    vertices += part.vertices;
    largest = std::max(largest, part.vertices);
    for (const parts::PartFile& file : part.files) bytes += file.bytes;
  }
  print_result(options.json,
               {{"output", options.output},
                {"vertices", plan.vertices},
                {"faces", plan.faces},
                {"parts", plan.parts},
                {"kept", result.kept},
                {"halo", plan.halo},
                {"mean_edge_length", plan.mean_edge_length},
                {"vertices_with_halo", vertices},
                {"largest_part", largest},
                {"bytes", bytes}},
               fmt::format("{}: {} vertices in {} part{} ({} kept), {} with the halos of {:.6g}, {}\n",
                           printable_name(options.output), plan.vertices, plan.parts, plan.parts == 1 ? "" : "s",
                           result.kept, vertices, plan.halo, bytes_text(static_cast<double>(bytes))));
}

}  // namespace

void add_partition(CLI::App& program) {
  const auto [command, options] = add_command(
      program, "partition", "Cut a mesh of any size into parts, each of which answers queries alone", partition_mesh);
  command
      .add_option("MESH", options.mesh.file,
                  "binary PLY, or positions as .npy with --faces: read in chunks; other formats: read into memory")
      ->check(stored_name("MESH"))
      ->required()
      ->type_name("");
  CLI::Option* faces =
      command.add_option("--faces", options.faces, "faces as .npy, (#F, k) integers; MESH then has the positions")
          ->check(stored_name("--faces"))
          ->type_name("FILE");
  for (CLI::Option* option : add_reading(command, options.mesh)) option->excludes(faces);
  command.get_option("--weld")->description(
      "join vertices at equal positions, or at most EPS apart; all keep their numbers, and the parts answer for those "
      "that were joined to another as for vertices without edges");
  CLI::Option* parts = add_number(command, "--parts", "number of parts", options.parts);
  add_number(command, "--vertices-per-part",
             "approximate number of vertices of a part without its halo; sets the number of parts",
             options.vertices_per_part)
      ->excludes(parts);
  command.add_option("--halo", options.halo, "the largest radius that the parts answer")
      ->type_name("NUMBER")
      ->required();
  add_unit(command, "halo", options.unit);
  command.add_option("--memory", options.memory, "most bytes of memory, for example 500MB or 4GiB (default: 1GiB)")
      ->transform(CLI::Validator(parse_size, ""))
      ->type_name("SIZE")
      ->default_val("1GiB");
  add_threads(command, options.threads);
  command.add_flag(
      "--no-resume", options.no_resume,
      "remove the parts that an earlier run has finished; if one has files of others, that is an error, and nothing is "
      "removed");
  command
      .add_option("-o,--output", options.output, "folder to write: a new or an empty one, or that of an earlier run")
      ->check(stored_name("--output"))
      ->type_name("FOLDER")
      ->required();
  add_json(command, options.json);
}

}  // namespace meshhood::cli
