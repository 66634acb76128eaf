// SPDX-License-Identifier: MIT
// meshhood view: a page that shows the mesh and its neighborhoods.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/messages.h"
#include "options.h"
#include "output.h"
#include "page.h"
#include "system.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

struct ViewCommand {
  std::string file;
  Reading reading;
  std::optional<std::uint64_t> vertex;
  Radius radius;
  std::string answer;
  std::string values;
  std::string output;
  bool open = false;
};

/// A page stores float. Values that are not finite get no color; others must not become infinite.
std::vector<float> as_floats(const std::vector<double>& values) {
  constexpr double kMost = std::numeric_limits<float>::max();
  std::vector<float> result;
  result.reserve(values.size());
  for (const double value : values) {
    if (std::isfinite(value) && std::abs(value) > kMost) {
      raise(ErrorCode::InvalidOption, fmt::format("values: vertex {}: {}, but a page holds numbers of at most {:.3g}",
                                                  result.size(), value, kMost));
    }
    result.push_back(static_cast<float>(value));
  }
  return result;
}

PageSettings settings_of(const ViewCommand& options, Input& input) {
  PageSettings settings;
  settings.name = path_of(options.file).filename().string();
  if (options.vertex) settings.vertex = resolve_vertex(*options.vertex, input);
  if (!options.radius.value.empty()) {
    settings.radius = resolve(options.radius, input);
    // JSON has no infinity.
    if (!std::isfinite(*settings.radius)) {
      raise(ErrorCode::InvalidRadius, fmt::format("radius {}, expected a finite number for a page", *settings.radius));
    }
  }
  if (!options.reading.weld.empty()) settings.weld = eps_of(options.reading.weld);
  settings.precision = options.reading.precision;
  if (!options.answer.empty()) {
    settings.answer = read_vertex_list(options.answer, input.vertex_count());
    for (VertexId& v : *settings.answer) v = input.welding().kept(v);
  }
  if (!options.values.empty()) {
    const std::vector<double> values = read_channel(options.values, input.vertex_count(), "values");
    settings.values = as_floats(values);
    settings.values_name = path_of(options.values).stem().string();
  }
  return settings;
}

void view(const ViewCommand& options) {
  const std::string output = options.output.empty() ? path_of(options.file).stem().string() + ".html" : options.output;
  if (options.output.empty()) name_output("--output", output);
  check_outputs();
  check_mesh_of_page(path_of(options.file));
  static_cast<void>(find_page());  // before the work begins
  Input input(options.file, options.reading);
  input.need_edges("view");
  write_page(path_of(output), path_of(options.file), input.other_as_ply(), settings_of(options, input));
  print_text(output + "\n");
  if (!options.open) return;
  if (const auto program = open_in_browser(std::filesystem::absolute(path_of(output))); !program.empty()) {
    print_error("warning: ", fmt::format("{} could not open {}", program, printable_name(output)));
  }
}

}  // namespace

void add_view(CLI::App& program) {
  auto options = std::make_shared<ViewCommand>();
  CLI::App* command =
      program.add_subcommand("view", "Write a page that shows the mesh and its neighborhoods in a browser");
  add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_number(*command, "-v,--vertex", "vertex to show at first, by its number in the file from 0", options->vertex);
  add_radius(*command, options->radius)->required(false);
  add_file_option(*command, "--ids", "show these vertices, one on each line, as printed by query", options->answer);
  add_file_option(*command, "--values",
                  "color the vertices by these numbers: one per line, or an array of NumPy (.npy)", options->values);
  add_output(*command, ".html", "the page; by default the name of FILE, in this folder", options->output);
  command->add_flag("--open", options->open, "also open the page in the browser");
  command->callback([options] { view(*options); });
}

}  // namespace meshhood::cli
