// SPDX-License-Identifier: MIT
// meshhood gaps: the nearest point of the surface in each ball that is not connected in it.
#include <algorithm>
#include <iterator>
#include <memory>
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
    const auto found = std::ranges::count_if(all, [](const SurfacePoint& one) { return one.face != kNoFace; });
    const auto none = std::ssize(all) - found;
    table.columns = columns_of(all, "corners", table.scales);
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
