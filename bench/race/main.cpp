// SPDX-License-Identifier: MIT
// Times methods in alternation on one mesh, and compares their answers with those of the first method. Prints one JSON
// document, which bench/programs.py reads.
#include <iostream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "meshhood/meshhood.h"

#include "contestants.h"
#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"
#include "radius_table.h"

namespace meshhood::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string mesh;
  std::vector<std::string> methods;
  std::string order = "cold";
  Plan plan{.radii = {2, 3, 5, 10, 20, 40, 65, 90}, .queries = 200};
  int builds = 0;
};

Json to_json(const Build& build) { return {{"name", build.name}, {"seconds", build.seconds}, {"bytes", build.bytes}}; }

Json to_json(const Measurement& m, const Contestant& method) {
  Json row{{"radius_edges", m.radius_edges},
           {"method", m.method},
           {"microseconds", m.microseconds},
           {"quartiles", {m.lower, m.upper}}};
  if (method.lists_vertices) row.update({{"count", m.count}, {"extra", m.extra}, {"missing", m.missing}});
  return row;
}

/// In bytes, counted as in the paper: positions and corners, and offsets unless all faces are triangles.
std::size_t bytes_of(const MeshView& mesh) {
  const std::size_t positions = mesh.positions.visit([](const auto& xyz) { return xyz.packed().size_bytes(); });
  const std::size_t offsets = mesh.faces.are_triangles() ? 0 : 4 * mesh.faces.offsets().size();
  return positions + 4 * mesh.faces.corners().size() + offsets;
}

std::size_t bytes_of(const AdjacencyView& adjacency) {
  return adjacency.offsets.size_bytes() + adjacency.neighbors.size_bytes();
}

Json race(const MeshView& mesh, Options& options) {
  Contestants contestants(mesh);
  std::vector<Contestant> methods;
  methods.reserve(options.methods.size());
  for (const std::string& name : options.methods) methods.push_back(contestants.method(name));
  const double unit = mean_edge_length(contestants.graph());
  Json rows = Json::array();
  if (!methods.empty()) {
    options.plan.order = options.order == "warm" ? Order::Warm : Order::Cold;
    const auto table = measure_radii(methods, options.plan, unit, contestants.order(),
                                     [](std::size_t /*done*/, std::size_t /*total*/) {});
    for (std::size_t i = 0; i < table.size(); ++i) rows.push_back(to_json(table[i], methods[i % methods.size()]));
  }
  Json builds = Json::array();
  if (options.builds > 0) {
    for (const Build& build : contestants.time_builds(options.builds)) builds.push_back(to_json(build));
  }
  const measure::Machine machine = measure::this_machine();
  return {{"mesh", options.mesh},
          {"vertices", mesh.positions.size()},
          {"faces", mesh.faces.size()},
          {"mesh_bytes", bytes_of(mesh)},
          {"topology_bytes", bytes_of(mesh) + bytes_of(contestants.graph().adjacency)},
          {"mean_edge_length", unit},
          {"compiler", machine.compiler},
          {"order", options.order},
          {"queries", options.plan.queries},
          {"builds", builds},
          {"rows", rows}};
}

int run(int arguments, char** values) {
  CLI::App program{"Times methods against each other on one mesh; one JSON document on standard output"};
  Options options;
  program.add_option("mesh", options.mesh, "mesh file, or a shape and its size: scroll:1000000")->required();
  program.add_option("--method", options.methods, "may be repeated; the others are compared with the first")
      ->allow_extra_args(false);
  program.add_option("--radii", options.plan.radii, "in mean edge lengths")->delimiter(',');
  program.add_option("--queries", options.plan.queries, "number per radius")->capture_default_str();
  program.add_option("--order", options.order)->check(CLI::IsMember({"cold", "warm"}))->capture_default_str();
  program.add_option("--builds", options.builds, "number of builds of each index")->capture_default_str();
  CLI11_PARSE(program, arguments, values);
  const MeshArgument mesh(options.mesh, io::Precision::Float);  // as in the tables of the paper
  std::cout << race(mesh.view(), options).dump() << '\n';
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int arguments, char** values) {
  return meshhood::bench::exit_status("race", [&] { return meshhood::bench::run(arguments, values); });
}
