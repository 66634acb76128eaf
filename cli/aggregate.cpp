// SPDX-License-Identifier: MIT
// meshhood aggregate: a mean, a sum or another aggregate of values over the neighborhood of each vertex.
#include "meshhood/aggregate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "options.h"
#include "row_table.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

constexpr Names<Reduce, 9> kReductions{{{"mean", Reduce::Mean},
                                        {"sum", Reduce::Sum},
                                        {"min", Reduce::Minimum},
                                        {"max", Reduce::Maximum},
                                        {"var", Reduce::Variance},
                                        {"std", Reduce::StandardDeviation},
                                        {"count", Reduce::Count},
                                        {"median", Reduce::Median},
                                        {"quantile", Reduce::Quantile}}};
constexpr Names<SmoothingKernel, 4> kKernels{{{"box", SmoothingKernel::Box},
                                              {"epanechnikov", SmoothingKernel::Epanechnikov},
                                              {"biweight", SmoothingKernel::Biweight},
                                              {"gaussian", SmoothingKernel::Gaussian}}};
constexpr Names<MissingValues, 2> kMissing{{{"propagate", MissingValues::Propagate}, {"omit", MissingValues::Omit}}};
constexpr Names<Nesting, 2> kNestings{{{"own", Nesting::Own}, {"patch", Nesting::Patch}}};

class AggregateQuantity : public Quantity {
 public:
  void add_options(CLI::App& command) override {
    add_file_option(command, "--values", "numbers by vertex: text with a line per vertex, or an array of NumPy (.npy)",
                    values_)
        ->required();
    add_choices(command, "--reduce", "what to compute", names_of(kReductions), reduce_);
    command
        .add_option("--quantile", quantile_, "of --reduce quantile, 0 to 1; between two values by linear interpolation")
        ->type_name("NUMBER")
        ->capture_default_str();
    CLI::Option* const kernel = add_choice(
        command, "--kernel",
        "how the weight falls with the distance, for sum and mean: box (not at all), epanechnikov, biweight or "
        "gaussian, which is 1/1000 at the radius",
        names_of(kKernels), kernel_);
    command
        .add_flag("--fwhm", fwhm_,
                  "a Gaussian of which the radii are full widths at half maximum; it ends at 1.578 times the width")
        ->excludes(kernel);
    add_file_option(command, "--weights",
                    "weights of the vertices: area, or a file like that of --values (default: 1 each)", weights_)
        ->type_name("area|FILE");
    add_choice(command, "--nan",
               "propagate: a neighborhood with a NaN gives NaN; omit: NaN is a missing value, left out",
               names_of(kMissing), missing_);
    add_choice(command, "--nesting",
               "with several radii; own: a neighborhood for each; patch: the neighborhood of the largest, cut by each",
               names_of(kNestings), nesting_);
    add_max_bytes(command, max_bytes_);
  }

  void check(const RowOptions& rows) const override {
    need_radii(rows);
    const auto has_kernels = [](const std::string& name) { return name == "mean" || name == "sum"; };
    if ((fwhm_ || kernel_ != "box") && !std::ranges::all_of(reduce_, has_kernels)) {
      const std::string option = fwhm_ ? "--fwhm" : "--kernel " + kernel_;
      wrong_option("{}: expected --reduce mean or sum", option);
    }
  }

  RowTable compute(const RowTask& task) override {
    RowTable table = task.table();
    if (fwhm_) std::ranges::transform(table.radii, table.radii.begin(), smoothing_radius);
    for (const double radius : table.radii) task.input.need_halo(radius);
    const Channels values = read_channels(values_, task.input.vertex_count());
    const std::vector<double> weights = weights_of(task.input);
    const SignalView signal{values.numbers, values.channels, weights};
    fill(table, aggregates(task, signal, query_of(task, table.radii)), values.channels);
    return table;
  }

 private:
  /// Borrows `radii` if they are of the rows.
  [[nodiscard]] AggregateQuery query_of(const RowTask& task, const std::vector<double>& radii) const {
    const BatchQuery batch = task.rows.query();
    std::vector<Reduce> reductions;
    reductions.reserve(reduce_.size());
    for (const std::string& name : reduce_) reductions.push_back(value_of(kReductions, name));
    return {.vertices = batch.vertices,
            .radius = batch.radius.scales() ? BatchRadius::scales(radii) : BatchRadius(radii),
            .metric = batch.metric,
            .reduce = std::move(reductions),
            .kernel = fwhm_ ? SmoothingKernel::Gaussian : value_of(kKernels, kernel_),
            .missing = value_of(kMissing, missing_),
            .nesting = value_of(kNestings, nesting_),
            .quantile = quantile_};
  }

  [[nodiscard]] std::vector<double> weights_of(Input& input) const {
    if (weights_.empty()) return {};
    if (weights_ == "area") {
      input.need_faces("--weights area");
      return vertex_areas(input.surface());
    }
    return read_channel(weights_, input.vertex_count(), "weights");
  }

  [[nodiscard]] std::vector<double> aggregates(const RowTask& task, const SignalView& signal,
                                               const AggregateQuery& query) const {
    const Index& index = task.input.exact_index(task.options.threads);
    const std::size_t numbers = aggregate_size(index, signal, query);
    const double least_bytes = task.files.table.is_csv() ? 2 : 8;  // of a number: a digit and a comma
    check_size(task.files.first(), max_bytes_, {task.rows.size(), numbers}, least_bytes * static_cast<double>(numbers));
    return task.while_shown("computing", task.options.scale_count(),
                            [&](const Run& run) { return aggregate(index, signal, query, run); });
  }

  /// Of several channels, the names of the properties end in the number of the channel.
  void fill(RowTable& table, std::vector<double> found, std::size_t channels) const {
    const std::size_t kinds = reduce_.size();
    table.columns = {{"values", std::move(found), table.scales, channels, true, kinds == 1 ? 0 : kinds}};
    for (std::size_t i = 0; i < table.scales; ++i) {
      for (std::size_t number = 0; number < channels * kinds; ++number) {
        const std::string end = channels == 1 ? "" : fmt::format("_{}", number / kinds);
        table.add_property_of_scale(reduce_[number % kinds], "values", i, number, 1, end);
      }
    }
    table.shown = table.properties[(table.scales - 1) * channels * kinds].name;
    table.summary = {{"reduce", reduce_}, {"channels", channels}};
    if (kinds == 1) {
      table.summary["reduce"] = reduce_.front();
    } else {
      table.kinds = reduce_;
    }
    table.text = fmt::format("{}, channels: {}", fmt::join(reduce_, ", "), channels);
    table.max_bytes = max_bytes_;
  }

  std::string values_;
  std::vector<std::string> reduce_{"mean"};
  double quantile_ = 0.5;
  std::string kernel_ = "box";
  bool fwhm_ = false;
  std::string weights_;  ///< "area", a file, or empty
  std::string missing_ = "propagate";
  std::string nesting_ = "own";
  std::optional<std::uint64_t> max_bytes_;
};

}  // namespace

void add_aggregate(CLI::App& program) {
  add_quantity(program,
               {.name = "aggregate",
                .description = "Write the mean or another aggregate of values over each neighborhood",
                .shown = "the first of --reduce for the first channel, at the last radius",
                .needs_faces = false},
               std::make_shared<AggregateQuantity>());
}

}  // namespace meshhood::cli
