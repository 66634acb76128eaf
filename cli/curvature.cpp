// SPDX-License-Identifier: MIT
// meshhood curvature: principal curvatures at one or several scales.
#include "meshhood/curvature.h"

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
#include "options.h"
#include "output.h"
#include "row_query.h"
#include "task.h"
#include "value_files.h"
#include "vertex_files.h"

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

/// How many rows have each state.
struct States {
  std::size_t fitted = 0;
  std::size_t rank_deficient = 0;
  std::size_t too_few = 0;
  std::size_t no_normal = 0;
  std::size_t extended = 0;

  void add(const std::vector<CurvatureState>& states) {
    for (const CurvatureState state : states) {
      fitted += static_cast<std::size_t>(state == CurvatureState::Fitted);
      rank_deficient += static_cast<std::size_t>(state == CurvatureState::RankDeficient);
      too_few += static_cast<std::size_t>(state == CurvatureState::TooFew);
      no_normal += static_cast<std::size_t>(state == CurvatureState::NoNormal);
      extended += static_cast<std::size_t>(state == CurvatureState::Extended);
    }
  }
};

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

void print(const CurvatureCommand& options, std::size_t rows, std::size_t scales, const States& states) {
  Json document = to_json(options.files);
  document.update({{"rows", rows},
                   {"radii", scales},
                   {"fitted", states.fitted},
                   {"extended", states.extended},
                   {"rank_deficient", states.rank_deficient},
                   {"too_few", states.too_few},
                   {"no_normal", states.no_normal}});
  print_result(
      options.json, document,
      fmt::format(
          "{}: {} rows, radii: {}; {} fitted, {} extended to six vertices, {} without a unique fit, {} of too few "
          "vertices, {} without a normal\n",
          names_of(options.files), rows, scales, states.fitted, states.extended, states.rank_deficient, states.too_few,
          states.no_normal));
}

void curvature(const CurvatureCommand& options) {
  check_value_files(options.files, options.rows.with_files({options.file}));
  Input input(options.file, options.reading, options.rows.threads);
  input.need_faces("curvature");
  const RowQuery rows(options.rows, input);
  const std::size_t scales = options.rows.scale_count();
  const Index& index = input.exact_index(options.rows.threads);
  const CurvatureIndex surface = CurvatureIndex::build(index, input.surface(), options.rows.threads);
  CurvatureOptions settings = options.like_libigl ? like_libigl() : CurvatureOptions{};
  settings.filter = !options.no_filter;
  settings.threads = options.rows.threads;
  Columns columns;
  States states;
  {
    Task task("fitting", {"rows", static_cast<double>(scales)});
    for (std::size_t i = 0; i < scales; ++i) {
      settings.progress = task.progress(i, scales);
      const Curvatures found = curvatures(surface, rows.query_of_scale(i), settings);
      states.add(found.state);
      columns.append(found);
    }
    if (!options.files.npz.empty()) write_npz(options.files.npz, rows, scales, columns);
  }
  if (options.files.has_mesh()) write_mesh(options.files, scales, columns, input.surface());
  print(options, rows.size(), scales, states);
}

}  // namespace

void add_curvature(CLI::App& program) {
  auto options = std::make_shared<CurvatureCommand>();
  CLI::App* command = program.add_subcommand("curvature", "Write the principal curvatures at one or several scales");
  add_surface(*command, options->file);
  add_reading(*command, options->reading);
  add_rows(*command, options->rows);
  command->add_flag("--like-libigl", options->like_libigl,
                    "the values of igl::principal_curvature, with the error of its shape operator");
  command->add_flag("--no-filter", options->no_filter,
                    "also fit vertices whose normal points away from that of the query vertex");
  add_value_files(*command, options->files, "the mean curvature at the last radius");
  add_json(*command, options->json);
  command->callback([options] { curvature(*options); });
}

}  // namespace meshhood::cli
