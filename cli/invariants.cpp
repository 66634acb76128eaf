// SPDX-License-Identifier: MIT
// meshhood invariants: the area of the surface in each ball, and the volume behind it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "meshhood/patch.h"

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

class InvariantsQuantity : public Quantity {
 public:
  RowTable compute(const RowTask& task) override {
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
};

}  // namespace

void add_invariants(CLI::App& program) {
  add_quantity(program,
               {.name = "invariants",
                .description = "Write the area of the surface in each ball, and the volume behind it",
                .shown = "the volume at the last radius",
                .has_metric = false},
               std::make_shared<InvariantsQuantity>());
}

}  // namespace meshhood::cli
