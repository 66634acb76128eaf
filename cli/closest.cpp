// SPDX-License-Identifier: MIT
// meshhood closest: the points of the surface nearest to points in space.
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

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
  RowTable table{.rows = found.size(), .columns = columns_of(found, "vertices")};
  for (const Column& column : table.columns) {
    table.add_property(column.name, column.name, 0, 0, column.channels == 0 ? 1 : column.channels);
  }
  return table;
}

void print(bool json, const std::vector<SurfacePoint>& found) {
  Json documents = Json::array();
  std::string text;
  for (const SurfacePoint& one : found) {
    documents.push_back(json_of(one));
    text += fmt::format("{} {} {}\n", one.face, fmt::join(one.point, " "), one.distance);
  }
  print_result(json, documents, text);
}

void closest(const ClosestCommand& options) {
  if (options.point.empty() == options.points.empty()) {
    wrong_option("expected either --point or --points");
  }
  check_outputs();
  Input input(options.reading, options.threads);
  input.need_faces("closest");
  const std::vector<SpacePoint> points =
      options.points.empty() ? std::vector{parse_point(options.point)} : read_points(options.points);
  const std::vector<SurfacePoint> found = compute(options, points, input);
  const std::string& output = options.output.name;
  if (output.empty()) return print(options.json, found);
  write_table(options.output, table_of(found));
  print_result(options.json, {{"output", output}, {"points", found.size()}},
               fmt::format("{}: {} points\n", printable_name(output), found.size()));
}

}  // namespace

void add_closest(CLI::App& program) {
  const auto [command, options] = add_command(
      program, "closest", "Print the face, point and distance of the surface nearest to points in space", closest);
  add_surface(command, options.reading);
  add_point(command, "a point in space; also X Y Z", options.point);
  add_file_option(command, "--points", "many points: text with X Y Z on each line, or an array of NumPy (.npy)",
                  options.points);
  add_threads(command, options.threads);
  add_table_output(command, ".npz",
                   "arrays or a table to write instead: face, distance, point, and the vertices of its triangle with "
                   "its barycentric coordinates",
                   options.output);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
