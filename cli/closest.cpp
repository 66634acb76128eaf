// SPDX-License-Identifier: MIT
// meshhood closest: the points of the surface nearest to points in space.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/error.h"
#include "meshhood/surface.h"

#include "commands.h"
#include "input.h"
#include "options.h"
#include "output.h"
#include "row_table.h"
#include "start.h"
#include "task.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

struct ClosestCommand {
  std::string file;
  Reading reading;
  std::vector<std::string> point;
  std::string points;  ///< a file with a list
  unsigned threads = kAllProcessors;
  TableFile output;
  bool json = false;
};

std::vector<SurfacePoint> compute(const ClosestCommand& options, std::span<const SpacePoint> points, Input& input) {
  const Surface surface(input.exact_index(options.threads), input.surface().faces);
  Task task("searching", {.name = "points"});
  return surface.closest_points(points, {.threads = options.threads, .progress = task.progress()});
}

RowTable table_of(const std::vector<SurfacePoint>& found) {
  std::vector<std::int64_t> faces;
  std::vector<double> distances;
  std::vector<double> points;
  std::vector<std::int64_t> vertices;
  std::vector<double> barycentric;
  for (const SurfacePoint& one : found) {
    faces.push_back(static_cast<std::int64_t>(one.face));
    distances.push_back(one.distance);
    points.insert(points.end(), one.point.begin(), one.point.end());
    vertices.insert(vertices.end(), one.vertices.begin(), one.vertices.end());
    barycentric.insert(barycentric.end(), one.barycentric.begin(), one.barycentric.end());
  }
  RowTable table{.rows = found.size()};
  table.columns = {{"face", std::move(faces)},
                   {"distance", std::move(distances)},
                   {"point", std::move(points), 0, 3},
                   {"vertices", std::move(vertices), 0, 3},
                   {"barycentric", std::move(barycentric), 0, 3}};
  table.add_property("face", "face");
  table.add_property("distance", "distance");
  table.add_property("point", "point", 0, 0, 3);
  for (const char* name : {"vertices", "barycentric"}) {
    for (std::size_t i = 0; i < 3; ++i) table.add_property(fmt::format("{}_{}", name, i), name, 0, i);
  }
  return table;
}

Json to_json(const std::vector<SurfacePoint>& found) {
  Json documents = Json::array();
  for (const SurfacePoint& one : found) {
    documents.push_back({{"face", one.face},
                         {"vertices", one.vertices},
                         {"barycentric", one.barycentric},
                         {"point", one.point},
                         {"distance", one.distance}});
  }
  return documents;
}

std::string to_text(const std::vector<SurfacePoint>& found) {
  std::string text;
  for (const SurfacePoint& one : found) {
    text += fmt::format("{} {} {}\n", one.face, fmt::join(one.point, " "), one.distance);
  }
  return text;
}

void closest(const ClosestCommand& options) {
  if (options.point.empty() == options.points.empty()) {
    raise(ErrorCode::InvalidOption, "expected either --point or --points");
  }
  check_outputs();
  Input input(options.file, options.reading, options.threads);
  input.need_faces("closest");
  const std::vector<SpacePoint> points =
      options.points.empty() ? std::vector{parse_point(options.point)} : read_points(options.points);
  const std::vector<SurfacePoint> found = compute(options, points, input);
  const std::string& output = options.output.name;
  if (output.empty()) return print_result(options.json, to_json(found), to_text(found));
  write_table(options.output, table_of(found));
  print_result(options.json, {{"output", output}, {"points", found.size()}},
               fmt::format("{}: {} points\n", printable_name(output), found.size()));
}

}  // namespace

void add_closest(CLI::App& program) {
  auto options = std::make_shared<ClosestCommand>();
  CLI::App* command =
      program.add_subcommand("closest", "Print the face, point and distance of the surface nearest to points in space");
  add_surface(*command, options->file);
  add_reading(*command, options->reading);
  add_point(*command, "a point in space; also X Y Z", options->point);
  add_file_option(*command, "--points", "many points: text with X Y Z on each line, or an array of NumPy (.npy)",
                  options->points);
  add_threads(*command, options->threads);
  add_table_output(*command, ".npz",
                   "arrays or a table to write instead: face, distance, point, and the vertices of its triangle with "
                   "its barycentric coordinates",
                   options->output);
  add_json(*command, options->json);
  command->callback([options] { closest(*options); });
}

}  // namespace meshhood::cli
