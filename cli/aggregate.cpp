// SPDX-License-Identifier: MIT
// meshhood aggregate: a mean, a sum or another aggregate of values over the neighborhood of each vertex.
#include "meshhood/aggregate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "methods.h"
#include "names.h"
#include "options.h"
#include "output.h"
#include "row_query.h"
#include "size_limit.h"
#include "task.h"
#include "value_files.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

constexpr Names<Reduce, 7> kReductions{{{"mean", Reduce::Mean},
                                        {"sum", Reduce::Sum},
                                        {"min", Reduce::Minimum},
                                        {"max", Reduce::Maximum},
                                        {"var", Reduce::Variance},
                                        {"std", Reduce::StandardDeviation},
                                        {"count", Reduce::Count}}};
constexpr Names<SmoothingKernel, 4> kKernels{{{"box", SmoothingKernel::Box},
                                              {"epanechnikov", SmoothingKernel::Epanechnikov},
                                              {"biweight", SmoothingKernel::Biweight},
                                              {"gaussian", SmoothingKernel::Gaussian}}};
constexpr Names<MissingValues, 2> kMissing{{{"propagate", MissingValues::Propagate}, {"omit", MissingValues::Omit}}};
constexpr Names<Nesting, 2> kNestings{{{"own", Nesting::Own}, {"patch", Nesting::Patch}}};

struct AggregateCommand {
  std::string file;
  Reading reading;
  std::string values;
  RowOptions rows;
  std::string reduce = "mean";
  std::string kernel = "box";
  bool fwhm = false;
  std::string weights;  ///< "area", a file, or empty
  std::string missing = "propagate";
  std::string nesting = "own";
  bool json = false;
  std::optional<std::uint64_t> max_bytes;
  ValueFiles files;
};

std::vector<double> weights_of(const AggregateCommand& options, Input& input) {
  if (options.weights.empty()) return {};
  if (options.weights == "area") {
    input.need_faces("--weights area");
    return vertex_areas(input.surface());
  }
  return read_channel(options.weights, input.vertex_count(), "weights");
}

/// The lengths of the result.
struct AggregateShape {
  std::size_t radii;
  std::size_t rows;
  std::size_t channels;
  std::size_t numbers;  ///< the product of the three
};

void write_npz(const std::string& file, const AggregateQuery& query, const BatchVertices& listed,
               const AggregateShape& shape, const std::vector<double>& result) {
  io::NpzWriter npz(file);
  write_radii(npz, query.radius);
  write_vertices(npz, listed);
  const std::array<std::uint64_t, 3> lengths{shape.radii, shape.rows, shape.channels};
  npz.begin<double>("values", lengths);
  npz.append<double>(result);
  Task::check_cancelled();
  npz.commit();
}

/// Of several channels, the names end in the number of the channel.
void write_mesh(const AggregateCommand& options, const AggregateShape& shape, const std::vector<double>& result,
                const MeshView& mesh) {
  VertexValues values(shape.rows);
  for (std::size_t i = 0; i < shape.radii; ++i) {
    for (std::size_t channel = 0; channel < shape.channels; ++channel) {
      const std::string end = shape.channels == 1 ? "" : fmt::format("_{}", channel);
      values.add(fmt::format("{}_{}{}", options.reduce, i, end),
                 [&](std::size_t v) { return result[(i * shape.rows + v) * shape.channels + channel]; });
    }
  }
  values.write(options.files, mesh, (shape.radii - 1) * shape.channels);
}

AggregateShape run(const AggregateCommand& options, Input& input, const AggregateQuery& query,
                   const BatchVertices& listed) {
  const Channels values = read_channels(options.values, input.vertex_count());
  const std::vector<double> weights = weights_of(options, input);
  const SignalView signal{values.numbers, values.channels, weights};
  const Index& index = input.exact_index(options.rows.threads);
  const AggregateShape shape{options.rows.scale_count(), query.vertices.count(index.vertex_count()), values.channels,
                             aggregate_size(index, signal, query)};
  const BatchSize size{shape.rows, shape.numbers};
  SizeLimit(options.files.first(), options.max_bytes).check(size, 8 * static_cast<double>(shape.numbers));
  std::vector<double> result;
  {
    Task task("computing", {"rows", static_cast<double>(shape.radii)});
    result = aggregate(index, signal, query, {.threads = options.rows.threads, .progress = task.progress()});
    if (!options.files.npz.empty()) write_npz(options.files.npz, query, listed, shape, result);
  }
  if (options.files.has_mesh()) write_mesh(options, shape, result, input.surface());
  return shape;
}

void aggregate_command(const AggregateCommand& options) {
  if ((options.fwhm || options.kernel != "box") && options.reduce != "mean" && options.reduce != "sum") {
    const std::string option = options.fwhm ? "--fwhm" : "--kernel " + options.kernel;
    raise(ErrorCode::InvalidOption, option + ": expected --reduce mean or sum");
  }
  check_value_files(options.files);
  Input input(options.file, options.reading, options.rows.threads);
  input.need_edges("aggregate");
  const RowQuery rows(options.rows, input);
  const BatchQuery batch = rows.query();
  std::vector<double> radii = rows.radii();
  if (options.fwhm) std::ranges::transform(radii, radii.begin(), smoothing_radius);
  const bool are_scales = batch.radius.scales().has_value();
  const AggregateQuery query{.vertices = batch.vertices,
                             .radius = are_scales ? BatchRadius::scales(radii) : BatchRadius(radii),
                             .metric = batch.metric,
                             .reduce = value_of(kReductions, options.reduce),
                             .kernel = options.fwhm ? SmoothingKernel::Gaussian : value_of(kKernels, options.kernel),
                             .missing = value_of(kMissing, options.missing),
                             .nesting = value_of(kNestings, options.nesting)};
  const AggregateShape shape = run(options, input, query, rows.listed());
  Json document = to_json(options.files);
  document.update(
      {{"reduce", options.reduce}, {"radii", shape.radii}, {"rows", shape.rows}, {"channels", shape.channels}});
  print_result(options.json, document,
               fmt::format("{}: {} of {} rows, radii: {}, channels: {}\n", names_of(options.files), options.reduce,
                           shape.rows, shape.radii, shape.channels));
}

}  // namespace

void add_aggregate(CLI::App& program) {
  auto options = std::make_shared<AggregateCommand>();
  CLI::App* command =
      program.add_subcommand("aggregate", "Write the mean or another aggregate of values over each neighborhood");
  add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_file_option(*command, "--values", "numbers by vertex: text with a line per vertex, or an array of NumPy (.npy)",
                  options->values)
      ->required();
  add_rows(*command, options->rows);
  add_metric(*command, options->rows.metric);
  add_choice(*command, "--reduce", "what to compute: mean, sum, min, max, var, std or count", names_of(kReductions),
             options->reduce);
  CLI::Option* const kernel = add_choice(
      *command, "--kernel",
      "how the weight falls with the distance, for sum and mean: box (not at all), epanechnikov, biweight or gaussian, "
      "which is 1/1000 at the radius",
      names_of(kKernels), options->kernel);
  command
      ->add_flag("--fwhm", options->fwhm,
                 "a Gaussian of which the radii are full widths at half maximum; it ends at 1.578 times the width")
      ->excludes(kernel);
  add_file_option(*command, "--weights",
                  "weights of the vertices: area, or a file like that of --values (default: 1 each)", options->weights)
      ->type_name("area|FILE");
  add_choice(*command, "--nan",
             "propagate: a neighborhood with a NaN gives NaN; omit: NaN is a missing value, left out",
             names_of(kMissing), options->missing);
  add_choice(*command, "--nesting",
             "with several radii; own: a neighborhood for each; patch: the neighborhood of the largest, cut by each",
             names_of(kNestings), options->nesting);
  add_max_bytes(*command, options->max_bytes);
  add_value_files(*command, options->files, "the first channel at the last radius");
  add_json(*command, options->json);
  command->callback([options] { aggregate_command(*options); });
}

}  // namespace meshhood::cli
