// SPDX-License-Identifier: MIT
// meshhood closest: the points of the surface nearest to points in space.
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/error.h"
#include "meshhood/surface.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "options.h"
#include "output.h"
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
  std::string output;
  bool json = false;
};

std::vector<SurfacePoint> compute(const ClosestCommand& options, std::span<const SpacePoint> points, Input& input) {
  const Surface surface(input.exact_index(options.threads), input.surface().faces);
  Task task("searching", {.name = "points"});
  return surface.closest_points(points, {.threads = options.threads, .progress = task.progress()});
}

void write_npz(const std::string& file, const std::vector<SurfacePoint>& found) {
  io::NpzWriter npz(file);
  const auto add = [&]<class T>(const char* name, auto&& numbers_of) {
    std::vector<T> numbers;
    for (const SurfacePoint& one : found) {
      for (const auto number : numbers_of(one)) numbers.push_back(static_cast<T>(number));
    }
    npz.begin<T>(name, std::array<std::uint64_t, 2>{found.size(), 3});
    npz.append<T>(numbers);
  };
  std::vector<std::int64_t> faces;
  std::vector<double> distances;
  for (const SurfacePoint& one : found) {
    faces.push_back(static_cast<std::int64_t>(one.face));
    distances.push_back(one.distance);
  }
  npz.add<std::int64_t>("face", faces);
  add.template operator()<std::int64_t>("vertices", [](const SurfacePoint& one) { return one.vertices; });
  add.template operator()<double>("weights", [](const SurfacePoint& one) { return one.weights; });
  add.template operator()<double>("point", [](const SurfacePoint& one) { return one.point; });
  npz.add<double>("distance", distances);
  npz.commit();
}

Json to_json(const std::vector<SurfacePoint>& found) {
  Json documents = Json::array();
  for (const SurfacePoint& one : found) {
    documents.push_back({{"face", one.face},
                         {"vertices", one.vertices},
                         {"weights", one.weights},
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
  if (options.output.empty()) return print_result(options.json, to_json(found), to_text(found));
  write_npz(options.output, found);
  print_result(options.json, {{"output", options.output}, {"points", found.size()}},
               fmt::format("{}: {} points\n", printable_name(options.output), found.size()));
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
  add_output(*command, ".npz",
             "arrays to write instead: face, distance, point, and the vertices of its triangle with their weights",
             options->output);
  add_json(*command, options->json);
  command->callback([options] { closest(*options); });
}

}  // namespace meshhood::cli
