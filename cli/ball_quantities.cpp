// SPDX-License-Identifier: MIT
// meshhood invariants, unconnected and gaps: quantities of a ball that have no options of their own.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/patch.h"
#include "meshhood/unconnected.h"

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

RowTable invariants_of(const RowTask& task) {
  const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
  RowTable table = task.table();
  Invariants found = task.while_shown("measuring", table.scales,
                                      [&](const Run& run) { return invariants(surface, task.rows.query(), run); });
  const auto none = std::ranges::count_if(found.volume, [](double volume) { return std::isnan(volume); });
  table.columns = {{"area", std::move(found.area), table.scales}, {"volume", std::move(found.volume), table.scales}};
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
  const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
  RowTable table = task.table();
  const std::vector<SurfacePoint> all = task.while_shown(
      "searching", table.scales, [&](const Run& run) { return gaps(surface, task.rows.query(), run); });
  const auto found = std::ranges::count_if(all, [](const SurfacePoint& one) { return one.face != kNoFace; });
  const auto none = std::ssize(all) - found;
  table.columns = columns_of(all, "corners", table.scales);
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
                .has_metric = false},
               invariants_of);
}

void add_unconnected(CLI::App& program) {
  add_quantity(program,
               {.name = "unconnected",
                .description = "Write the nearest vertex of each ball that is not connected in it",
                .shown = "the distance at the last radius",
                .needs_faces = false},
               unconnected_of);
}

void add_gaps(CLI::App& program) {
  add_quantity(program,
               {.name = "gaps",
                .description = "Write the nearest point of the surface in each ball that is not connected in it",
                .shown = "the gap at the last radius",
                .has_metric = false},
               gaps_of);
}

}  // namespace meshhood::cli
