// SPDX-License-Identifier: MIT
// meshhood features: feature vectors over several scales, and how long each feature persists.
#include "meshhood/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/aggregate.h"
#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "methods.h"
#include "names.h"
#include "options.h"
#include "output.h"
#include "row_query.h"
#include "task.h"
#include "value_files.h"

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

struct FeaturesCommand {
  std::string file;
  Reading reading;
  RowOptions rows;
  std::string smallest;
  std::string largest;
  std::size_t count = 16;
  std::vector<std::string> kinds{"crease"};
  double threshold = 0.5;
  bool no_filter = false;
  ValueFiles files;
  bool json = false;
};

std::vector<Feature> kinds_of(const FeaturesCommand& options) {
  std::vector<Feature> kinds;
  kinds.reserve(options.kinds.size());
  for (const std::string& name : options.kinds) kinds.push_back(value_of(kKinds, name));
  return kinds;
}

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

/// The radii of all rows, ascending. With --radii there is one scale, that of each row.
std::vector<double> radii_of(const FeaturesCommand& options, const RowQuery& rows, Input& input) {
  const Radii& typed = options.rows.radii;
  const bool has_rows = !options.rows.row_radii.empty();
  if ((typed.values.empty() && !has_rows) == options.largest.empty()) {
    raise(ErrorCode::InvalidOption, "expected either --radius, --radii or --largest");
  }
  if (has_rows) return {1};
  if (options.largest.empty()) return rows.radii();
  if (options.count == 0) raise(ErrorCode::InvalidOption, "--count is 0, expected 1 to 1000");
  const auto in_mesh = [&](const std::string& radius) { return resolve(Radius{radius, typed.unit}, input); };
  if (options.smallest.empty()) return equal_steps(in_mesh(options.largest), options.count);
  return geometric_radii(in_mesh(options.smallest), in_mesh(options.largest), options.count);
}

/// The features of all rows, and how long each kind persists.
struct FeaturesFound {
  std::vector<double> radii;  // of the scales; with --radii, 1
  std::size_t kinds;
  std::vector<double> values;  // #radii by #rows by #kinds
  std::vector<Persistence> lasting;

  [[nodiscard]] std::size_t rows() const { return values.size() / radii.size() / kinds; }
  [[nodiscard]] double at(std::size_t radius, std::size_t row, std::size_t kind) const {
    return values[(radius * rows() + row) * kinds + kind];
  }
};

FeaturesFound compute(const FeaturesCommand& options, const RowQuery& rows, Input& input) {
  FeaturesFound found{radii_of(options, rows, input), options.kinds.size(), {}, {}};
  static_cast<void>(persistence({}, found.radii, options.threshold));  // refuses wrong radii before the work begins
  const Surface surface(input.exact_index(options.rows.threads), input.surface());
  Task task("measuring", {"rows", static_cast<double>(found.radii.size())});
  const bool has_rows = !options.rows.row_radii.empty();
  found.values = features(surface, has_rows ? rows.query() : rows.query(BatchRadius::scales(found.radii)),
                          {.kinds = kinds_of(options), .filter = !options.no_filter},
                          {.threads = options.rows.threads, .progress = task.progress()});
  for (std::size_t kind = 0; kind < found.kinds; ++kind) {
    std::vector<double> one(found.radii.size() * found.rows());
    for (std::size_t i = 0; i < one.size(); ++i) one[i] = found.values[i * found.kinds + kind];
    Persistence& lasting = found.lasting.emplace_back(persistence(one, found.radii, options.threshold));
    for (std::size_t row = 0; has_rows && row < found.rows(); ++row) lasting.radius[row] *= rows.radii()[row];
  }
  return found;
}

void write_npz(const FeaturesCommand& options, const FeaturesFound& found, const RowQuery& rows) {
  io::NpzWriter npz(options.files.npz);
  write_radii(npz, options.rows.row_radii.empty() ? BatchRadius::scales(found.radii) : rows.query().radius);
  write_vertices(npz, rows.listed());
  npz.add_texts("kinds", options.kinds);
  const std::array<std::uint64_t, 3> shape{found.radii.size(), found.rows(), found.kinds};
  npz.begin<double>("features", shape);
  npz.append<double>(found.values);
  const auto add = [&]<class T>(const char* name, std::vector<T> Persistence::* array) {
    npz.begin<T>(name, std::span(shape).last(2));
    for (std::size_t row = 0; row < found.rows(); ++row) {
      for (const Persistence& one : found.lasting) npz.append(std::span<const T>(&(one.*array)[row], 1));
    }
  };
  add("scales", &Persistence::scales);
  add("strength", &Persistence::strength);
  add("radius", &Persistence::radius);
  npz.commit();
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

void write_mesh(const FeaturesCommand& options, const FeaturesFound& found, const MeshView& mesh) {
  VertexValues values(found.rows());
  for (std::size_t kind = 0; kind < found.kinds; ++kind) {
    const std::string& name = options.kinds[kind];
    for (std::size_t i = 0; i < found.radii.size(); ++i) {
      values.add(fmt::format("{}_{}", name, i), [&](std::size_t row) { return found.at(i, row, kind); });
    }
    const Persistence& lasting = found.lasting[kind];
    values.add(name + "_scales", [&](std::size_t row) { return lasting.scales[row]; });
    values.add(name + "_strength", [&](std::size_t row) { return lasting.strength[row]; });
    values.add(name + "_radius", [&](std::size_t row) { return lasting.radius[row]; });
  }
  const std::size_t last = found.radii.size() - 1;
  std::vector<std::uint8_t> colors;
  for (std::size_t row = 0; row < found.rows(); ++row) {
    const auto color = color_of(found.at(last, row, 0), options.threshold);
    colors.insert(colors.end(), color.begin(), color.end());
  }
  values.write(options.files, mesh, last, colors);
}

void print(const FeaturesCommand& options, const FeaturesFound& found) {
  std::vector<std::size_t> lasting;
  lasting.reserve(found.lasting.size());
  for (const Persistence& one : found.lasting) {
    lasting.push_back(static_cast<std::size_t>(
        std::count_if(one.scales.begin(), one.scales.end(), [](std::int32_t scales) { return scales != 0; })));
  }
  std::string text = fmt::format("{} rows, {} radii\n", found.rows(), found.radii.size());
  for (std::size_t kind = 0; kind < found.kinds; ++kind) {
    text += fmt::format("{}: {} vertices at {} or more\n", options.kinds[kind], lasting[kind], options.threshold);
  }
  Json document = to_json(options.files);
  document["rows"] = found.rows();
  if (options.rows.row_radii.empty()) document["radii"] = found.radii;
  document.update({{"kinds", options.kinds}, {"threshold", options.threshold}, {"lasting", lasting}});
  print_result(options.json, document, text);
}

void features_command(const FeaturesCommand& options) {
  check_value_files(options.files);
  Input input(options.file, options.reading, options.rows.threads);
  input.need_faces("features");
  const RowQuery rows(options.rows, input);
  const FeaturesFound found = compute(options, rows, input);
  if (!options.files.npz.empty()) write_npz(options, found, rows);
  if (options.files.has_mesh()) write_mesh(options, found, input.surface());
  print(options, found);
}

void add_radii(CLI::App& command, FeaturesCommand& options) {
  add_rows(command, options.rows)->required(false);
  add_metric(command, options.rows.metric);
  command
      .add_option("--largest", options.largest,
                  "the largest of --count radii, in equal steps, or with --smallest in equal ratios")
      ->excludes("--radii")
      ->type_name("NUMBER");
  command.add_option("--smallest", options.smallest, "the smallest of --count radii")
      ->excludes("--radii")
      ->type_name("NUMBER")
      ->needs("--largest");
  add_number(command, "--count", "number of radii up to --largest", options.count, 1000)
      ->capture_default_str()
      ->excludes("--radii")
      ->needs("--largest");
}

}  // namespace

void add_features(CLI::App& program) {
  auto options = std::make_shared<FeaturesCommand>();
  CLI::App* command = program.add_subcommand("features", "Write creases and other features at many scales");
  add_surface(*command, options->file);
  add_reading(*command, options->reading);
  add_radii(*command, *options);
  command
      ->add_option("--kinds", options->kinds,
                   fmt::format("what to compute, separated by commas: {}", fmt::join(names_of(kKinds), ", ")))
      ->delimiter(',')
      ->check(one_of(names_of(kKinds)))
      ->type_name("NAMES")
      ->capture_default_str();
  command->add_option("--threshold", options->threshold, "the least strength of a feature that persists")
      ->type_name("NUMBER")
      ->capture_default_str();
  command->add_flag("--no-filter", options->no_filter,
                    "also fit vertices whose normal points away from that of the query vertex");
  add_value_files(*command, options->files,
                  "the first kind at the largest radius; the colors of PLY show it, too, blue below 0, red above");
  add_json(*command, options->json);
  command->callback([options] { features_command(*options); });
}

}  // namespace meshhood::cli
