// SPDX-License-Identifier: MIT
// meshhood invariants, unconnected and gaps: quantities of a ball that have no options of their own.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/patch.h"
#include "meshhood/surface.h"
#include "meshhood/unconnected.h"

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

/// What `find(surface, rows..., run)` returns for the rows of the task. For those of --points, adds to the table where
/// they are.
template <class F>
auto of_patches(const RowTask& task, std::string_view description, RowTable& table, const F& find) {
  const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
  const auto found_for = [&](const auto&... rows) {
    return task.while_shown(description, table.scales, [&](const Run& run) { return find(surface, rows..., run); });
  };
  if (!task.rows.points()) return found_for(task.rows.query());
  std::vector<std::int64_t> faces;
  std::vector<SpacePoint> points;
  std::vector<double> coordinates;
  for (const SurfacePoint& nearest : task.while_shown(
           "searching", 1, [&](const Run& run) { return surface.closest_points(*task.rows.points(), run); })) {
    faces.push_back(static_cast<std::int64_t>(nearest.face));
    points.push_back(nearest.point);
    coordinates.insert(coordinates.end(), nearest.point.begin(), nearest.point.end());
  }
  auto found = found_for(IndicesView(faces), std::span<const SpacePoint>(points), task.rows.all_radii());
  table.of_vertices = false;
  table.columns = {{"start_face", std::move(faces)}, {"start_point", std::move(coordinates), 0, 3}};
  table.add_property("start_face", "start_face");
  table.add_property("start_point", "start_point", 0, 0, 3);
  return found;
}

RowTable invariants_of(const RowTask& task) {
  RowTable table = task.table();
  Invariants found =
      of_patches(task, "measuring", table, [](const auto&... arguments) { return invariants(arguments...); });
  const auto none = std::ranges::count_if(found.volume, [](double volume) { return std::isnan(volume); });
  table.columns.push_back({"area", std::move(found.area), table.scales});
  table.columns.push_back({"volume", std::move(found.volume), table.scales});
  table.add_properties({"area", "volume"});
  table.shown = fmt::format("volume_{}", table.scales - 1);
  table.summary = {{"without_volume", none}};
  table.text = fmt::format("{} without a volume", none);
  return table;
}

RowTable unconnected_of(const RowTask& task) {
  task.input.ignore_welded();
  const Index& index = task.input.exact_index(task.options.threads);
  RowTable table = task.table();
  Unconnected all = task.while_shown(
      "searching", table.scales, [&](const Run& run) { return nearest_unconnected(index, task.rows.query(), run); });
  std::vector<std::int64_t> others(all.vertex.size());  // -1 where there is none
  std::ranges::transform(all.vertex, others.begin(), [](VertexId v) { return v == kNoVertex ? -1 : std::int64_t{v}; });
  const auto none = static_cast<std::size_t>(std::count(others.begin(), others.end(), -1));
  const std::size_t found = others.size() - none;
  table.columns = {{"other", std::move(others), table.scales}, {"distance", std::move(all.distance), table.scales}};
  table.add_properties({"other", "distance"});
  table.shown = fmt::format("distance_{}", table.scales - 1);
  table.summary = {{"found", found}, {"none", none}};
  table.text = fmt::format("{} with an unconnected vertex, {} without", found, none);
  return table;
}

RowTable gaps_of(const RowTask& task) {
  RowTable table = task.table();
  const std::vector<SurfacePoint> all =
      of_patches(task, "searching", table, [](const auto&... arguments) { return gaps(arguments...); });
  const auto found = std::ranges::count_if(all, [](const SurfacePoint& one) { return one.face != kNoFace; });
  const auto none = std::ssize(all) - found;
  for (Column& column : columns_of(all, "corners", table.scales)) table.columns.push_back(std::move(column));
  table.add_properties({"distance", "face", "point", "corners", "barycentric"});
  table.shown = fmt::format("distance_{}", table.scales - 1);
  table.summary = {{"found", found}, {"none", none}};
  table.text = fmt::format("{} with a gap, {} without", found, none);
  return table;
}

}  // namespace

void add_invariants(CLI::App& program) {
  add_quantity(program,
               {.name = "invariants",
                .description = "Write the area of the surface in each ball, and the volume behind it",
                .shown = "the volume at the last radius",
                .of_patch = true},
               invariants_of);
}

void add_unconnected(CLI::App& program) {
  add_quantity(program,
               {.name = "unconnected",
                .description = "Write the nearest vertex of each ball that is not connected in it",
                .shown = "the distance at the last radius",
                .needs_faces = false,
                .takes_space = false},
               unconnected_of);
}

void add_gaps(CLI::App& program) {
  add_quantity(program,
               {.name = "gaps",
                .description = "Write the nearest point of the surface in each ball that is not connected in it",
                .shown = "the gap at the last radius",
                .of_patch = true},
               gaps_of);
}

}  // namespace meshhood::cli
