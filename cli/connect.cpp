// SPDX-License-Identifier: MIT
// meshhood connect: the radii at which vertices join the neighborhood of a vertex.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/search.h"

#include "commands.h"
#include "input.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "start.h"

namespace meshhood::cli {
namespace {

struct ConnectCommand {
  Reading reading;
  StartOptions start;
  std::vector<std::uint64_t> targets;
  std::optional<std::uint64_t> nearest;
  std::string metric = "straight";
  bool json = false;
};

struct Connections {
  std::vector<VertexId> vertices;
  std::vector<double> radii;  ///< of each vertex; infinite if no radius connects it
};

Connections connections_of(const ConnectCommand& options, Input& input) {
  const std::vector<QueryStart> starts = starts_of(options.start, options.metric, input);
  const Start start = starts.front().view();
  Searcher searcher = make_searcher(options.metric, input);
  Connections found;
  if (options.nearest) {
    const std::size_t k = std::min<std::size_t>(*options.nearest, input.vertex_count());
    searcher.nearest_connected(start, k, found.vertices, found.radii);
  }
  for (const std::uint64_t target : options.targets) {
    const VertexId w = resolve_vertex(target, input);
    found.vertices.push_back(w);
    found.radii.push_back(searcher.connecting_radius(start, w));
  }
  for (const double radius : found.radii) input.need_halo(radius);  // another part may have a shorter way
  return found;
}

void connect(const ConnectCommand& options) {
  if (options.targets.empty() == !options.nearest) {
    wrong_option("expected either --to or --nearest");
  }
  if (options.nearest == std::uint64_t{0}) wrong_option("--nearest: 0, expected at least 1");
  if (options.nearest && options.metric == "space") {
    wrong_option("--nearest: expected another --metric than space, in which nothing is connected");
  }
  check_start_options(options.start, false, options.metric);
  Input input(options.reading);
  input.need_edges("connect");
  const Connections found = connections_of(options, input);
  std::string text;
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    text += fmt::format("{} {}\n", found.vertices[i], found.radii[i]);
  }
  // JSON has no infinity: such a radius is null.
  print_result(options.json, {{"vertices", found.vertices}, {"radii", found.radii}}, text);
}

}  // namespace

void add_connect(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "connect", "Print the smallest radii at which vertices belong to a neighborhood", connect);
  add_file(command, options.reading);
  add_start(command, "the vertex of the neighborhood, by its number in the file from 0", options.start);
  add_numbers(command, "--to", "vertices to connect; prints each with its radius, or inf if no radius connects it",
              options.targets);
  add_number(command, "--nearest",
             "instead of --to: the number of vertices to print, in the order of the radii that connect them; not by "
             "--metric space",
             options.nearest);
  add_metric(command, options.metric);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
