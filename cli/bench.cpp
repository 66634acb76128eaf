// SPDX-License-Identifier: MIT
// meshhood bench: the paper's Table 1 and Table 2 for one mesh.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "measure/radius_table.h"
#include "measure/timing.h"
#include "options.h"
#include "output.h"
#include "task.h"

namespace meshhood::cli {
namespace {

constexpr std::uint64_t kMostQueries = 100'000'000;

using measure::Machine;
using measure::Measurement;

struct BenchCommand {
  std::string file;
  std::string radii = "2,3,5,10,20,40,65,90";
  std::string order = "cold";
  measure::Plan plan;
  bool json = false;
};

/// Memory in bytes, counted as in the paper. An index file has no faces, so their figures are empty.
struct Table1 {
  std::size_t vertices;
  std::optional<std::size_t> faces;
  std::optional<std::size_t> mesh_bytes;      ///< positions and corners, and offsets unless all faces are triangles
  std::optional<std::size_t> topology_bytes;  ///< the same and the adjacency
  std::size_t index_bytes;                    ///< of the paper's index
  double build_seconds;                       ///< processor time
  std::size_t exact_index_bytes;
  double exact_build_seconds;
};

std::size_t bytes_of(const MeshView& mesh) {
  const std::size_t positions = mesh.positions.visit([](const auto& xyz) { return xyz.packed().size_bytes(); });
  const std::size_t offsets = mesh.faces.are_triangles() ? 0 : 4 * mesh.faces.offsets().size();
  return positions + 4 * mesh.faces.corners().size() + offsets;
}

std::size_t bytes_of(const AdjacencyView& adjacency) {
  return adjacency.offsets.size_bytes() + adjacency.neighbors.size_bytes();
}

template <class Index>
struct Timed {
  Index index;
  double seconds;
};

template <class Build>
auto timed(Build&& build) {
  const double start = measure::processor_time();
  auto index = build();
  return Timed<decltype(index)>{std::move(index), measure::processor_time() - start};
}

struct Indexes {
  Timed<paper::Index> paper;
  Timed<Index> exact;
};

/// Builds both indexes for the timing, with one thread. `Mesh`: MeshView or GraphView.
template <class Mesh>
Indexes build_indexes(const Mesh& mesh) {
  return {timed([&] { return build_paper_index(mesh); }), timed([&] { return build_exact_index(mesh, 1); })};
}

Table1 table1(Input& input, const Indexes& built) {
  Table1 table{.vertices = input.vertex_count(),
               .faces = {},
               .mesh_bytes = {},
               .topology_bytes = {},
               .index_bytes = built.paper.index.bytes().total(),
               .build_seconds = built.paper.seconds,
               .exact_index_bytes = built.exact.index.bytes().total(),
               .exact_build_seconds = built.exact.seconds};
  if (const io::Mesh* mesh = input.mesh()) {
    table.faces = mesh->view().faces.size();
    table.mesh_bytes = bytes_of(mesh->view());
    table.topology_bytes = *table.mesh_bytes + bytes_of(input.graph().adjacency);
  }
  return table;
}

std::vector<Measurement> table2(Input& input, const Indexes& built, const measure::Plan& plan) {
  std::vector<measure::Contestant> contestants{measure::contestant("bfs", SearchMethod::breadth_first(input.graph())),
                                               measure::contestant("ball", SearchMethod::ball_scan(input.positions())),
                                               measure::contestant("paper", built.paper.index),
                                               measure::contestant("exact", built.exact.index)};
  contestants[1].visits_all_vertices = true;
  Task task("measuring");
  return measure::measure_radii(contestants, plan, mean_edge_length(input.graph()), built.paper.index.permutation(),
                                [&](std::size_t done, std::size_t total) {
                                  task.report(done, total);
                                  Task::check_cancelled();
                                });
}

Json or_null(const std::optional<std::size_t>& value) { return value ? Json(*value) : Json(); }

Json to_json(const Table1& t) {
  return {{"vertices", t.vertices},
          {"faces", or_null(t.faces)},
          {"mesh_bytes", or_null(t.mesh_bytes)},
          {"topology_bytes", or_null(t.topology_bytes)},
          {"index_bytes", t.index_bytes},
          {"build_seconds", t.build_seconds},
          {"exact_index_bytes", t.exact_index_bytes},
          {"exact_build_seconds", t.exact_build_seconds}};
}

Json to_json(const std::vector<Measurement>& table) {
  Json rows = Json::array();
  for (const Measurement& m : table) {
    rows.push_back({{"radius_edges", m.radius_edges},
                    {"method", m.method},
                    {"microseconds", m.microseconds},
                    {"quartiles", {m.lower, m.upper}},
                    {"count", m.count},
                    {"extra", m.extra},
                    {"missing", m.missing}});
  }
  return rows;
}

Json to_json(const Machine& machine) {
  return {{"processor", machine.processor}, {"compiler", machine.compiler}, {"build", machine.build}};
}

std::string to_text(const Table1& t) {
  const auto megabytes = [](std::size_t bytes) { return fmt::format("{:.3f} MB", static_cast<double>(bytes) / 1e6); };
  Rows rows(13);
  rows.add("vertices", t.vertices);
  if (t.faces) rows.add("faces", *t.faces);
  if (t.mesh_bytes) rows.add("plain mesh", megabytes(*t.mesh_bytes));
  if (t.topology_bytes) rows.add("with topology", megabytes(*t.topology_bytes));
  rows.add("paper's index", fmt::format("{}, built in {:.3f} s", megabytes(t.index_bytes), t.build_seconds));
  rows.add("exact index", fmt::format("{}, built in {:.3f} s", megabytes(t.exact_index_bytes), t.exact_build_seconds));
  return rows.text();
}

std::string to_text(const std::vector<Measurement>& table) {
  std::string text = "radius/edge  method  microseconds      count      extra  missing\n";
  for (const Measurement& m : table) {
    text += fmt::format("{:>11g}  {:<6} {:>13.3f} {:>10.1f} {:>10.2f} {:>8.2f}\n", m.radius_edges, m.method,
                        m.microseconds, m.count, m.extra, m.missing);
  }
  return text;
}

measure::Plan plan_of(const BenchCommand& options) {
  measure::Plan plan = options.plan;
  if (plan.queries == 0) raise(ErrorCode::InvalidOption, "--queries 0, expected at least 1");
  plan.order = options.order == "warm" ? measure::Order::Warm : measure::Order::Cold;
  for (const std::string& radius : split_list(options.radii)) {
    plan.radii.push_back(parse_radius("--radii", radius));
  }
  return plan;
}

void bench(const BenchCommand& options) {
  const measure::Plan plan = plan_of(options);
  Input input(options.file);
  input.need_edges("bench");
  if (input.graph().adjacency.neighbors.empty()) {
    raise(ErrorCode::InvalidMesh, options.file + ": has no edges, so there is nothing to measure");
  }
  const Indexes built = input.mesh() != nullptr ? build_indexes(input.mesh()->view()) : build_indexes(input.graph());
  const Table1 space = table1(input, built);
  const std::vector<Measurement> curves = table2(input, built, plan);
  const Machine machine = measure::this_machine();
  print_result(
      options.json,
      {{"mesh", input.name()}, {"machine", to_json(machine)}, {"table1", to_json(space)}, {"table2", to_json(curves)}},
      fmt::format("{} on {}, {}, {}\n\n{}\n{}", printable_name(input.name()), machine.processor, machine.compiler,
                  machine.build, to_text(space), to_text(curves)));
}

}  // namespace

void add_bench(CLI::App& program) {
  auto options = std::make_shared<BenchCommand>();
  CLI::App* command = program.add_subcommand("bench", "Measure the paper's Table 1 and Table 2 on a mesh");
  add_file(*command, options->file);
  command->add_option("--radii", options->radii, "radii, in mean edge lengths")
      ->type_name("NUMBERS")
      ->capture_default_str();
  add_number(*command, "--queries", "number of queries per radius", options->plan.queries, kMostQueries)
      ->capture_default_str();
  add_choice(*command, "--order", "cold: query vertices far apart; warm: each next to the one before", {"cold", "warm"},
             options->order);
  add_number(*command, "--seed", "seed of the random query vertices", options->plan.seed)->capture_default_str();
  add_json(*command, options->json);
  command->callback([options] { bench(*options); });
}

}  // namespace meshhood::cli
