// SPDX-License-Identifier: MIT
// meshhood unconnected: what is near each vertex, but not connected with it.
#include "meshhood/unconnected.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

class UnconnectedQuantity : public Quantity {
 public:
  RowTable compute(const RowTask& task) override {
    task.input.ignore_welded();
    const Index& index = task.input.exact_index(task.options.threads);
    RowTable table = task.table();
    Unconnected all = task.while_shown(
        "searching", table.scales, [&](const Run& run) { return nearest_unconnected(index, task.rows.query(), run); });
    std::vector<std::int64_t> others(all.vertex.size());  // -1 where there is none
    std::ranges::transform(all.vertex, others.begin(),
                           [](VertexId v) { return v == kNoVertex ? -1 : std::int64_t{v}; });
    const auto none = static_cast<std::size_t>(std::count(others.begin(), others.end(), -1));
    const std::size_t found = others.size() - none;
    table.columns = {{"other", std::move(others), table.scales}, {"distance", std::move(all.distance), table.scales}};
    table.add_properties({"other", "distance"});
    table.shown = fmt::format("distance_{}", table.scales - 1);
    table.summary = {{"found", found}, {"none", none}};
    table.text = fmt::format("{} with an unconnected vertex, {} without", found, none);
    return table;
  }
};

}  // namespace

void add_unconnected(CLI::App& program) {
  add_quantity(program,
               {.name = "unconnected",
                .description = "Write the nearest vertex of each ball that is not connected in it",
                .shown = "the distance at the last radius",
                .needs_faces = false},
               std::make_shared<UnconnectedQuantity>());
}

}  // namespace meshhood::cli
