// SPDX-License-Identifier: MIT
// meshhood features: feature vectors over several scales, and how long each feature persists.
#include "meshhood/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/aggregate.h"

#include "commands.h"
#include "options.h"
#include "row_table.h"

namespace meshhood::cli {
namespace {

constexpr Names<Feature, 12> kKinds{{{"crease", Feature::Crease},
                                     {"mean", Feature::Mean},
                                     {"gaussian", Feature::Gaussian},
                                     {"k1", Feature::K1},
                                     {"k2", Feature::K2},
                                     {"curvedness", Feature::Curvedness},
                                     {"shape_index", Feature::ShapeIndex},
                                     {"area", Feature::Area},
                                     {"volume", Feature::Volume},
                                     {"gap", Feature::Gap},
                                     {"height", Feature::Height},
                                     {"variation", Feature::Variation}}};

/// R / count, 2 R / count, ..., R: the radii of multi-scale integral invariants (H. Mara, S. Krömker, S. Jakob,
/// B. Breuckmann, "GigaMesh and Gilgamesh: 3D multiscale integral invariant cuneiform character extraction", VAST
/// 2010).
std::vector<double> equal_steps(double largest, std::size_t count) {
  std::vector<double> radii;
  radii.reserve(count);
  for (std::size_t i = 1; i <= count; ++i) {
    radii.push_back(largest * (static_cast<double>(i) / static_cast<double>(count)));
  }
  return radii;
}

/// From blue over white to red, as the value goes from below to above 0; half way at `half`.
std::array<std::uint8_t, 3> color_of(double value, double half) {
  constexpr std::array<double, 3> kNegative{33, 82, 166};
  constexpr std::array<double, 3> kZero{244, 243, 239};
  constexpr std::array<double, 3> kPositive{178, 34, 34};
  if (std::isnan(value)) return {128, 128, 128};
  const double strength = std::abs(value) / (std::abs(value) + half);
  const double share = strength * strength * (3 - 2 * strength);  // without a kink at 0
  std::array<std::uint8_t, 3> color;
  for (std::size_t i = 0; i < 3; ++i) {
    const double end = value < 0 ? kNegative[i] : kPositive[i];
    color[i] = static_cast<std::uint8_t>(std::lround(kZero[i] + share * (end - kZero[i])));
  }
  return color;
}

/// What a color stands for, 0 on a plane. On a sphere, that of a volume is r times the mean curvature.
double colored_value(std::string_view kind, double value) {
  if (kind == "area") return value - 1;
  if (kind == "volume") return 16.0 / 3 * (0.5 - value);
  return value;
}

class FeaturesQuantity : public Quantity {
 public:
  void add_options(CLI::App& command) override {
    add_steps(command);
    add_choices(command, "--kinds", "what to compute", names_of(kKinds), kinds_);
    command.add_option("--threshold", threshold_, "the least strength of a feature that persists")
        ->type_name("NUMBER")
        ->capture_default_str();
    command.add_flag("--no-filter", no_filter_,
                     "also fit vertices whose normal points away from that of the query vertex");
  }

  void check(const RowOptions& rows) const override {
    if (rows.has_radii() == largest_.empty()) return;
    wrong_option("expected either --radius, --radii or --largest");
  }

  RowTable compute(const RowTask& task) override {
    const bool has_rows = !task.options.row_radii.empty();
    RowTable table = task.table();
    const std::vector<double> scales = scales_of(task);
    if (!has_rows) table.radii = scales;
    if (!largest_.empty())
      std::ranges::transform(scales, std::back_inserter(table.scale_names), fmt::to_string<double>);
    table.scales = scales.size();
    static_cast<void>(persistence({}, scales, threshold_));  // refuses wrong radii before the work begins
    table.kinds = kinds_;
    add_features(table, values_of(task, scales), scales.size());
    add_lasting(table, scales, has_rows);
    describe(table);
    return table;
  }

 private:
  void add_steps(CLI::App& command) {
    command
        .add_option("--largest", largest_,
                    "the largest of --count radii, in equal steps, or with --smallest in equal ratios")
        ->excludes("--radii")
        ->type_name("NUMBER");
    command.add_option("--smallest", smallest_, "the smallest of --count radii")
        ->excludes("--radii")
        ->type_name("NUMBER")
        ->needs("--largest");
    add_number(command, "--count", "number of radii up to --largest", count_, 1000)
        ->capture_default_str()
        ->excludes("--radii")
        ->needs("--largest");
  }

  /// The radii of all rows, ascending. With --radii there is one scale, that of each row, which is 1.
  [[nodiscard]] std::vector<double> scales_of(const RowTask& task) const {
    const Radii& typed = task.options.radii;
    if (!task.options.row_radii.empty()) return {1};
    if (largest_.empty()) return task.rows.radii();
    if (count_ == 0) wrong_option("--count is 0, expected 1 to 1000");
    const auto in_mesh = [&](const std::string& radius) { return resolve(Radius{radius, typed.unit}, task.input); };
    if (smallest_.empty()) return equal_steps(in_mesh(largest_), count_);
    return geometric_radii(in_mesh(smallest_), in_mesh(largest_), count_);
  }

  [[nodiscard]] std::vector<double> values_of(const RowTask& task, const std::vector<double>& scales) const {
    std::vector<Feature> kinds(kinds_.size());
    std::ranges::transform(kinds_, kinds.begin(), [](const std::string& name) { return value_of(kKinds, name); });
    const Surface surface(task.input.exact_index(task.options.threads), task.input.surface());
    const bool has_rows = !task.options.row_radii.empty();
    const BatchQuery query = has_rows ? task.rows.query() : task.rows.query(BatchRadius::scales(scales));
    return task.while_shown("measuring", scales.size(), [&](const Run& run) {
      return features(surface, query, {.kinds = kinds, .filter = !no_filter_}, run);
    });
  }

  void add_features(RowTable& table, std::vector<double> values, std::size_t scales) const {
    const std::size_t last = (scales - 1) * table.rows * kinds_.size();
    for (std::size_t row = 0; row < table.rows; ++row) {
      const double value = colored_value(kinds_.front(), values[last + row * kinds_.size()]);
      const auto color = color_of(value, threshold_);
      table.colors.insert(table.colors.end(), color.begin(), color.end());
    }
    table.columns = {{"features", std::move(values), scales, kinds_.size()},
                     {"scales", std::vector<std::int32_t>(table.rows * kinds_.size()), 0, kinds_.size()},
                     {"strength", std::vector<double>(table.rows * kinds_.size()), 0, kinds_.size()},
                     {"radius", std::vector<double>(table.rows * kinds_.size()), 0, kinds_.size()}};
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      for (std::size_t i = 0; i < scales; ++i) {
        table.add_property_of_scale(kinds_[kind], "features", i, kind);
      }
      for (const char* name : {"scales", "strength", "radius"}) {
        table.add_property(fmt::format("{}_{}", kinds_[kind], name), name, 0, kind);
      }
    }
    table.shown = fmt::format("{}_{}", kinds_.front(), scales - 1);
  }

  /// How long each kind persists. In the scale 1, a radius is a share of that of the row.
  void add_lasting(RowTable& table, const std::vector<double>& scales, bool has_rows) const {
    const auto& values = std::get<std::vector<double>>(table.columns[0].numbers);
    auto& counts = std::get<std::vector<std::int32_t>>(table.columns[1].numbers);
    auto& strengths = std::get<std::vector<double>>(table.columns[2].numbers);
    auto& radii = std::get<std::vector<double>>(table.columns[3].numbers);
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      std::vector<double> one(scales.size() * table.rows);
      for (std::size_t i = 0; i < one.size(); ++i) one[i] = values[i * kinds_.size() + kind];
      const Persistence lasting = persistence(one, scales, threshold_);
      for (std::size_t row = 0; row < table.rows; ++row) {
        const std::size_t place = row * kinds_.size() + kind;
        counts[place] = lasting.scales[row];
        strengths[place] = lasting.strength[row];
        radii[place] = has_rows ? lasting.radius[row] * table.radii[row] : lasting.radius[row];
      }
    }
  }

  void describe(RowTable& table) const {
    const auto& counts = std::get<std::vector<std::int32_t>>(table.columns[1].numbers);
    std::vector<std::size_t> lasting(kinds_.size());
    for (std::size_t i = 0; i < counts.size(); ++i) lasting[i % kinds_.size()] += counts[i] != 0 ? 1 : 0;
    table.text = fmt::format("vertices at {} or more", threshold_);
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      table.text += fmt::format("{} {} {}", kind == 0 ? ":" : ",", kinds_[kind], lasting[kind]);
    }
    table.summary.update({{"kinds", kinds_}, {"threshold", threshold_}, {"lasting", lasting}});
  }

  std::string smallest_;
  std::string largest_;
  std::size_t count_ = 16;
  std::vector<std::string> kinds_{"crease"};
  double threshold_ = 0.5;
  bool no_filter_ = false;
};

}  // namespace

void add_features(CLI::App& program) {
  add_quantity(program,
               {.name = "features",
                .description = "Write creases and other features at many scales",
                .shown = "the first kind at the largest radius; the colors of PLY show it, too, blue below what it is "
                         "on a plane, red above; of a volume, red on ridges"},
               std::make_shared<FeaturesQuantity>());
}

}  // namespace meshhood::cli
