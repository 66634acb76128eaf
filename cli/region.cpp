// SPDX-License-Identifier: MIT
// meshhood region: the part of the mesh in a neighborhood, as a mesh of its own.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/surface.h"

#include "commands.h"
#include "input.h"
#include "io/mesh_io.h"
#include "io/npz_writer.h"
#include "options.h"
#include "output.h"
#include "start.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct RegionCommand {
  std::string file;
  Reading reading;
  Radius radius;
  StartOptions start;
  std::string faces = "all";
  std::string output;
  std::string arrays;
  bool json = false;
};

void write_mesh(const std::string& file, const PositionsView& whole, const Submesh& part) {
  Task task("writing " + file);
  whole.visit([&]<class Real>(const StridedPositions<Real>& all) {
    std::vector<Real> positions;
    for (const VertexId v : part.vertices) positions.insert(positions.end(), {all(v, 0), all(v, 1), all(v, 2)});
    io::write_ply(file, {positions, FacesView::polygons(part.offsets, part.corners)}, {.progress = task.progress()});
  });
}

SpacePoint center_of(const Start& start, const PositionsView& positions) {
  if (start.center()) return *start.center();
  const std::size_t v = start.vertex();
  return positions.visit([v](const auto& all) { return SpacePoint{all(v, 0), all(v, 1), all(v, 2)}; });
}

template <class T, class Value, std::size_t N>
void add_rows(io::NpzWriter& npz, const std::string& name, const std::vector<std::array<Value, N>>& rows) {
  npz.begin<T>(name, std::array<std::uint64_t, 2>{rows.size(), N});
  for (const auto& row : rows) {
    std::array<T, N> values;
    std::copy(row.begin(), row.end(), values.begin());
    npz.append(std::span<const T>(values));
  }
}

template <class Value>
void add_numbers_of(io::NpzWriter& npz, const std::string& name, const std::vector<Value>& values) {
  npz.add<std::int64_t>(name, std::vector<std::int64_t>(values.begin(), values.end()));
}

void write_arrays(const std::string& file, const Submesh& part, const Rim& rim) {
  io::NpzWriter npz(file);
  add_numbers_of(npz, "vertices", part.vertices);
  add_numbers_of(npz, "faces", part.faces);
  add_rows<double>(npz, "rim_points", rim.points);
  add_rows<std::int64_t>(npz, "rim_edges", rim.edges);
  add_numbers_of(npz, "rim_offsets", rim.offsets);
  add_numbers_of(npz, "rim_closed", rim.closed);
  npz.commit();
}

void region(const RegionCommand& options) {
  check_start_options(options.start, false);
  check_outputs();
  Input input(options.file, options.reading);
  input.need_faces("region");
  const StartQuery query(options.start, "straight", input);
  const QueryStart& start = query.starts.front();
  const double radius = resolve(options.radius, input);
  const std::vector<VertexId> ids = regions_of(start, "straight", std::span(&radius, 1), input).vertices;
  const Surface surface(input.exact_index(), input.surface().faces);
  const Submesh part = surface.submesh(ids, options.faces == "all" ? Corners::All : Corners::Any);
  const Rim rim = surface.rim(ids, center_of(start.view(), input.positions()), radius);
  write_mesh(options.output, input.positions(), part);
  if (!options.arrays.empty()) write_arrays(options.arrays, part, rim);
  const auto closed = static_cast<std::size_t>(std::count(rim.closed.begin(), rim.closed.end(), 1));
  print_result(options.json,
               {{"output", options.output},
                {"vertices", part.vertices.size()},
                {"faces", part.faces.size()},
                {"closed_lines", closed},
                {"open_lines", rim.size() - closed}},
               fmt::format("{}: {} vertices, {} faces; rim lines: {} closed, {} open\n", printable_name(options.output),
                           part.vertices.size(), part.faces.size(), closed, rim.size() - closed));
}

}  // namespace

void add_region(CLI::App& program) {
  auto options = std::make_shared<RegionCommand>();
  CLI::App* command = program.add_subcommand("region", "Write the part of the mesh in a neighborhood, and its rim");
  add_surface(*command, options->file);
  add_reading(*command, options->reading);
  add_radius(*command, options->radius);
  add_start(*command, "query vertex, by its number in the file from 0", options->start);
  add_choice(*command, "--faces", "all: the faces with all corners in the neighborhood; any: with at least one corner",
             {"all", "any"}, options->faces);
  add_output(*command, ".ply", "mesh file to write", options->output)->required();
  add_output(*command, ".npz",
             "also write the number in MESH of each vertex and face of the output, and the rim: the lines where the "
             "surface leaves the ball",
             options->arrays, "--arrays");
  add_json(*command, options->json);
  command->callback([options] { region(*options); });
}

}  // namespace meshhood::cli
