// SPDX-License-Identifier: MIT
// meshhood curvature: principal curvatures at one or several scales.
#include "meshhood/curvature.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "row_query.h"
#include "task.h"
#include "value_files.h"

namespace meshhood::cli {
namespace {

struct CurvatureCommand {
  std::string file;
  Reading reading;
  RowOptions rows;
  bool like_libigl = false;
  bool no_filter = false;
  ValueFiles files;
  bool json = false;
};

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

/// Radius after radius, as one array of each name.
struct Columns {
  std::vector<double> k1;
  std::vector<double> k2;
  std::vector<double> d1;
  std::vector<double> d2;
  std::vector<std::int32_t> state;

  void append(const Curvatures& found) {
    k1.insert(k1.end(), found.k1.begin(), found.k1.end());
    k2.insert(k2.end(), found.k2.begin(), found.k2.end());
    d1.insert(d1.end(), found.d1.begin(), found.d1.end());
    d2.insert(d2.end(), found.d2.begin(), found.d2.end());
    for (const CurvatureState one : found.state) state.push_back(static_cast<std::int32_t>(one));
  }
};

void write_npz(const std::string& file, const RowQuery& rows, std::size_t scales, const Columns& columns) {
  io::NpzWriter npz(file);
  write_radii(npz, rows.query().radius);
  write_vertices(npz, rows.listed());
  const std::array<std::uint64_t, 3> shape{scales, rows.size(), 3};
  const auto add = [&](const char* name, const auto& values, std::size_t dimensions) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    npz.begin<Value>(name, std::span(shape).first(dimensions));
    npz.append(std::span<const Value>(values));
  };
  add("k1", columns.k1, 2);
  add("k2", columns.k2, 2);
  add("d1", columns.d1, 3);
  add("d2", columns.d2, 3);
  add("state", columns.state, 2);
  npz.commit();
}

void write_mesh(const ValueFiles& files, std::size_t scales, const Columns& columns, const MeshView& mesh) {
  const std::size_t rows = mesh.positions.size();
  VertexValues values(rows);
  for (std::size_t i = 0; i < scales; ++i) {
    const std::size_t first = i * rows;
    values.add(fmt::format("mean_{}", i),
               [&](std::size_t v) { return (columns.k1[first + v] + columns.k2[first + v]) / 2; });
    values.add(fmt::format("k1_{}", i), [&](std::size_t v) { return columns.k1[first + v]; });
    values.add(fmt::format("k2_{}", i), [&](std::size_t v) { return columns.k2[first + v]; });
    values.add(fmt::format("state_{}", i), [&](std::size_t v) { return columns.state[first + v]; });
    values.add_vectors(fmt::format("d1_{}", i), std::span(columns.d1).subspan(3 * first, 3 * rows));
    values.add_vectors(fmt::format("d2_{}", i), std::span(columns.d2).subspan(3 * first, 3 * rows));
  }
  constexpr std::size_t kColumns = 6;
  values.write(files, mesh, (scales - 1) * kColumns);
}

void print(const CurvatureCommand& options, std::size_t rows, std::size_t scales, const Columns& columns) {
  Json document = to_json(options.files);
  document.update({{"rows", rows}, {"radii", scales}});
  std::string text;
  for (const auto& [state, key, name] : kStates) {
    const auto count = std::count(columns.state.begin(), columns.state.end(), static_cast<std::int32_t>(state));
    document[key] = count;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  print_result(options.json, document,
               fmt::format("{}: {} rows, radii: {}; {}\n", names_of(options.files), rows, scales, text));
}

void curvature(const CurvatureCommand& options) {
  check_value_files(options.files);
  Input input(options.file, options.reading, options.rows.threads);
  input.need_faces("curvature");
  const RowQuery rows(options.rows, input);
  const std::size_t scales = options.rows.scale_count();
  const Surface surface(input.exact_index(options.rows.threads), input.surface());
  CurvatureOptions settings = options.like_libigl ? like_libigl() : CurvatureOptions{};
  settings.filter = !options.no_filter;
  Columns columns;
  {
    Task task("fitting", {"rows", static_cast<double>(scales)});
    for (std::size_t i = 0; i < scales; ++i) {
      columns.append(curvatures(surface, rows.query_of_scale(i), settings,
                                {.threads = options.rows.threads, .progress = task.progress(i, scales)}));
    }
    if (!options.files.npz.empty()) write_npz(options.files.npz, rows, scales, columns);
  }
  if (options.files.has_mesh()) write_mesh(options.files, scales, columns, input.surface());
  print(options, rows.size(), scales, columns);
}

}  // namespace

void add_curvature(CLI::App& program) {
  auto options = std::make_shared<CurvatureCommand>();
  CLI::App* command = program.add_subcommand("curvature", "Write the principal curvatures at one or several scales");
  add_surface(*command, options->file);
  add_reading(*command, options->reading);
  add_rows(*command, options->rows);
  add_metric(*command, options->rows.metric);
  command->add_flag("--like-libigl", options->like_libigl,
                    "the values of igl::principal_curvature, with the error of its shape operator");
  command->add_flag("--no-filter", options->no_filter,
                    "also fit vertices whose normal points away from that of the query vertex");
  add_value_files(*command, options->files, "the mean curvature at the last radius");
  add_json(*command, options->json);
  command->callback([options] { curvature(*options); });
}

}  // namespace meshhood::cli
