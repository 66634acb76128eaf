// SPDX-License-Identifier: MIT
// meshhood gaps: the nearest point of the surface in each ball that is not connected in it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/patch.h"

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

class GapsQuantity : public Quantity {
 public:
  RowTable compute(const RowTask& task) override {
    const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
    RowTable table = task.table();
    const std::vector<SurfacePoint> all = task.while_shown(
        "searching", table.scales, [&](const Run& run) { return gaps(surface, task.rows.query(), run); });
    std::vector<double> distances;
    std::vector<std::int64_t> faces;  // -1 where there is none
    std::vector<double> points;
    std::vector<std::int64_t> corners;
    std::vector<double> barycentric;
    std::size_t found = 0;
    for (const SurfacePoint& one : all) {
      distances.push_back(one.distance);
      faces.push_back(one.face == kNoFace ? -1 : static_cast<std::int64_t>(one.face));
      points.insert(points.end(), one.point.begin(), one.point.end());
      for (const VertexId v : one.vertices) corners.push_back(v == kNoVertex ? -1 : std::int64_t{v});
      barycentric.insert(barycentric.end(), one.barycentric.begin(), one.barycentric.end());
      found += one.face == kNoFace ? 0 : 1;
    }
    const std::size_t none = faces.size() - found;
    table.columns = {
        {"distance", std::move(distances), table.scales},
        {"face", std::move(faces), table.scales},
        {"point", std::move(points), table.scales, 3},
        {.name = "corners", .numbers = std::move(corners), .scales = table.scales, .channels = 3, .of_triangle = true},
        {.name = "barycentric",
         .numbers = std::move(barycentric),
         .scales = table.scales,
         .channels = 3,
         .of_triangle = true}};
    table.add_properties({"distance", "face", "point", "corners", "barycentric"});
    table.shown = fmt::format("distance_{}", table.scales - 1);
    table.summary = {{"found", found}, {"none", none}};
    table.text = fmt::format("{} with a gap, {} without", found, none);
    return table;
  }
};

}  // namespace

void add_gaps(CLI::App& program) {
  add_quantity(program,
               {.name = "gaps",
                .description = "Write the nearest point of the surface in each ball that is not connected in it",
                .shown = "the gap at the last radius",
                .has_metric = false},
               std::make_shared<GapsQuantity>());
}

}  // namespace meshhood::cli
