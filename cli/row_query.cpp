// SPDX-License-Identifier: MIT
#include "row_query.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "methods.h"
#include "system.h"

namespace meshhood::cli {
namespace {

std::optional<std::vector<VertexId>> list_of(const std::string& file, const Input& input) {
  if (file.empty()) return std::nullopt;
  if (file.find_first_not_of("0123456789,") == std::string::npos && !std::filesystem::exists(path_of(file))) {
    raise(ErrorCode::InvalidOption,
          fmt::format("--vertices {}: expected a file that lists vertices, or - for standard input", file));
  }
  std::vector<VertexId> list = read_vertex_list(file, input.vertex_count());
  for (VertexId& v : list) v = input.welding().kept(v);
  return list;
}

BatchVertices rows_of(const std::optional<std::vector<VertexId>>& list, const Input& input) {
  if (list) return *list;
  return input.welding().count() > 0 ? BatchVertices(input.welding().kept()) : BatchVertices();
}

std::vector<double> radii_of(const RowOptions& options, std::size_t rows, Input& input) {
  if (options.row_radii.empty()) return resolve(options.radii, input);
  std::vector<double> radii = read_channel(options.row_radii, rows, "radii");
  const double unit = resolve(Radius{"1", options.radii.unit}, input);
  for (std::size_t row = 0; row < rows; ++row) {
    if (!(radii[row] >= 0)) {
      raise(ErrorCode::InvalidRadius, fmt::format("{}: row {}: radius {}, expected a number >= 0",
                                                  io::printable_name(options.row_radii), row, radii[row]));
    }
    radii[row] *= unit;
  }
  return radii;
}

}  // namespace

void add_rows(CLI::App& command, RowOptions& options) {
  CLI::Option* const radius = add_radii(command, options.radii)->required(false);
  add_file_option(command, "--radii",
                  "instead of --radius, one for each row: text with a number per line, or an array of NumPy (.npy)",
                  options.row_radii)
      ->excludes(radius);
  add_file_option(command, "-v,--vertices", "text file with the query vertices, one per line (default: all)",
                  options.vertices);
  add_masks(command, options.masks);
  add_threads(command, options.threads);
}

void need_radii(const RowOptions& options) {
  if (!options.has_radii()) raise(ErrorCode::InvalidOption, "expected --radius or --radii");
}

RowQuery::RowQuery(const RowOptions& options, Input& input)
    : list_(list_of(options.vertices, input)),
      rows_(rows_of(list_, input)),
      metric_(choose_metric(options.metric, input)),
      size_(rows_.count(input.vertex_count())),
      are_of_rows_(!options.row_radii.empty()),
      radii_(radii_of(options, size_, input)) {
  check_metric(options.metric, options.radii.unit);
  input.set_masks(read_masks(options.masks, input));
  if (metric_ == Metric::Space) input.ignore_welded();
}

BatchQuery RowQuery::query(BatchRadius radius) const {
  return {.vertices = rows_, .radius = std::move(radius), .metric = metric_};
}

void write_vertices(io::NpzWriter& npz, const BatchVertices& rows) {
  if (!rows.list()) return;
  npz.add_converted<std::int64_t>("vertices", *rows.list());
}

void write_radii(io::NpzWriter& npz, const BatchRadius& radius) {
  if (radius.scales()) return npz.add<double>("radii", *radius.scales());
  npz.begin<double>("radii", std::array<std::uint64_t, 2>{1, radius.list()->size()});
  npz.append<double>(*radius.list());
}

}  // namespace meshhood::cli
