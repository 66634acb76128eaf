// SPDX-License-Identifier: MIT
// meshhood curvature: principal curvatures at one or several scales.
#include "meshhood/curvature.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

/// The states by the names of JSON, and what the text says of how many rows have each.
struct StateName {
  CurvatureState state;
  const char* key;
  const char* text;
};
constexpr std::array kStates{StateName{CurvatureState::Fitted, "fitted", "fitted"},
                             StateName{CurvatureState::Extended, "extended", "extended to six vertices"},
                             StateName{CurvatureState::RankDeficient, "rank_deficient", "without a unique fit"},
                             StateName{CurvatureState::TooFew, "too_few", "of too few vertices"},
                             StateName{CurvatureState::NoNormal, "no_normal", "without a normal"}};

class CurvatureQuantity : public Quantity {
 public:
  void add_options(CLI::App& command) override {
    command.add_flag("--like-libigl", like_libigl_,
                     "the values of igl::principal_curvature, with the error of its shape operator");
    command.add_flag("--no-filter", no_filter_,
                     "also fit vertices whose normal points away from that of the query vertex");
  }

  RowTable compute(const RowTask& task) override {
    const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
    CurvatureOptions settings = like_libigl_ ? like_libigl() : CurvatureOptions{};
    settings.filter = !no_filter_;
    return table_of(task, task.while_shown("fitting", task.options.scale_count(), [&](const Run& run) {
      return curvatures(surface, task.rows.query(), settings, run);
    }));
  }

 private:
  static RowTable table_of(const RowTask& task, Curvatures all) {
    RowTable table = task.table();
    const std::size_t scales = table.scales;
    describe(table, all.state);
    std::vector<double> mean(all.k1.size());
    std::vector<std::int32_t> state(mean.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
      mean[i] = (all.k1[i] + all.k2[i]) / 2;
      state[i] = static_cast<std::int32_t>(all.state[i]);
    }
    table.columns = {{"k1", std::move(all.k1), scales},    {"k2", std::move(all.k2), scales},
                     {"d1", std::move(all.d1), scales, 3}, {"d2", std::move(all.d2), scales, 3},
                     {"state", std::move(state), scales},  {"mean", std::move(mean), scales, 0, false}};
    table.add_properties({"mean", "k1", "k2", "state", "d1", "d2"});
    table.shown = fmt::format("mean_{}", scales - 1);
    return table;
  }

  /// How many rows have each state.
  static void describe(RowTable& table, const std::vector<CurvatureState>& states) {
    for (const auto& [state, key, name] : kStates) {
      const auto count = std::count(states.begin(), states.end(), state);
      table.summary[key] = count;
      table.text += fmt::format("{}{} {}", table.text.empty() ? "" : ", ", count, name);
    }
  }

  bool like_libigl_ = false;
  bool no_filter_ = false;
};

}  // namespace

void add_curvature(CLI::App& program) {
  add_quantity(program,
               {.name = "curvature",
                .description = "Write the principal curvatures at one or several scales",
                .shown = "the mean curvature at the last radius"},
               std::make_shared<CurvatureQuantity>());
}

}  // namespace meshhood::cli
