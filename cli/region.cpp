// SPDX-License-Identifier: MIT
// meshhood region: the part of the mesh in a neighborhood, as a mesh of its own.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/patch.h"
#include "meshhood/surface.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "mesh_file.h"
#include "options.h"
#include "output.h"
#include "row_table.h"
#include "start.h"
#include "system.h"

namespace meshhood::cli {
namespace {

struct RegionCommand {
  Reading reading;
  Radius radius;
  StartOptions start;
  std::string faces = "all";
  std::optional<double> tolerance;
  std::string output;
  std::string arrays;
  bool json = false;
};

void write_mesh(const std::string& file, const PositionsView& whole, const Submesh& part) {
  whole.visit([&]<class Real>(const StridedPositions<Real>& all) {
    std::vector<Real> positions;
    for (const VertexId v : part.vertices) positions.insert(positions.end(), {all(v, 0), all(v, 1), all(v, 2)});
    write_ply(file, {positions, FacesView::polygons(part.offsets, part.corners)});
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

void write_arrays(const std::string& file, const Submesh& part, const Rim& rim) {
  io::NpzWriter npz(path_of(file));
  npz.add_converted<std::int64_t>("vertices", part.vertices);
  npz.add_converted<std::int64_t>("faces", part.faces);
  add_rows<double>(npz, "rim_points", rim.points);
  add_rows<std::int64_t>(npz, "rim_edges", rim.edges);
  npz.add_converted<std::int64_t>("rim_offsets", rim.offsets);
  npz.add_converted<std::int64_t>("rim_closed", rim.closed);
  npz.commit();
}

/// Of a vertex, or of the point of the surface that is nearest to --point.
PatchStart patch_start(const QueryStart& start, const Surface& surface) {
  if (start.vertex()) return *start.vertex();
  const Start center = start.view();
  const SurfacePoint nearest = surface.closest_point(*center.center());
  return {nearest.face, nearest.point};
}

void clip(const RegionCommand& options, const QueryStart& start, double radius, const Surface& surface) {
  const PatchStart from = patch_start(start, surface);
  PatchSearcher searcher(surface);
  const ClippedMesh part = searcher.clip(from, radius, options.tolerance.value_or(1e-3));
  const double volume = searcher.measure(from, radius).volume;
  const SurfacePoint gap = searcher.gap(from, radius);
  write_ply(options.output, part.view());
  if (!options.arrays.empty()) {
    io::NpzWriter npz(path_of(options.arrays));
    add_rows<std::int64_t>(npz, "vertices", part.vertices);
    add_rows<double>(npz, "weights", part.weights);
    npz.add_converted<std::int64_t>("faces", part.faces);
    npz.add_converted<std::int64_t>("patch", searcher.patch(from, radius));
    npz.commit();
  }
  print_result(options.json,
               {{"output", options.output},
                {"vertices", part.points.size()},
                {"faces", part.triangles.size()},
                {"area", part.area},
                {"volume", volume},
                {"gap", gap.distance},
                {"gap_point", gap.face == kNoFace ? Json() : json_of(gap)}},
               fmt::format("{}: {} vertices, {} triangles; area {:.6g}, volume {:.6g}, gap {:.6g}\n",
                           printable_name(options.output), part.points.size(), part.triangles.size(), part.area, volume,
                           gap.distance));
}

void region(const RegionCommand& options) {
  check_start_options(options.start, false);
  const bool clips = options.faces == "clip";
  if (clips && !options.start.seeds.empty()) {
    wrong_option("--faces clip: starts at the nearest point of the surface, expected no --seed");
  }
  if (options.tolerance && !clips) wrong_option("--tolerance: expected --faces clip");
  check_outputs();
  Input input(options.reading);
  input.need_faces("region");
  const std::vector<QueryStart> starts = starts_of(options.start, "straight", input);
  const QueryStart& start = starts.front();
  const double radius = resolve(options.radius, input);
  const Surface surface(input.exact_index(), input.surface().faces);
  if (clips) return clip(options, start, radius, surface);
  const std::vector<VertexId> ids = RegionSearch("straight", input).regions(start, std::span(&radius, 1)).vertices;
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
  const auto [command, options] =
      add_command(program, "region", "Write the part of the mesh in a neighborhood, and its rim", region);
  add_surface(command, options.reading);
  add_radius(command, options.radius);
  add_start(command, "query vertex, by its number in the file from 0", options.start);
  add_choice(
      command, "--faces",
      "all: the faces with all corners in the neighborhood; any: with at least one corner; clip: the connected "
      "surface in the ball, in triangles that end at the sphere, which is around the vertex, or the point of the "
      "surface nearest to --point",
      {"all", "any", "clip"}, options.faces);
  command
      .add_option("--tolerance", options.tolerance,
                  "with --faces clip: how far chords may be from the arcs of the sphere, in radii, from 1e-12 to 1; "
                  "by default 0.001")
      ->type_name("SHARE");
  add_output(command, ".ply", "mesh file to write", options.output)->required();
  add_output(command, ".npz",
             "also write the number in MESH of each vertex and face of the output, and the rim: the lines where the "
             "surface leaves the ball; with --faces clip three vertices and weights for each vertex, the faces of the "
             "patch, and no rim",
             options.arrays, "--arrays");
  add_json(command, options.json);
}

}  // namespace meshhood::cli
