// SPDX-License-Identifier: MIT
// meshhood unconnected: what is near each vertex, but not connected with it.
#include "meshhood/unconnected.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

struct UnconnectedCommand {
  std::string file;
  Reading reading;
  RowOptions rows;
  ValueFiles files;
  bool json = false;
};

/// Radius after radius.
struct Gaps {
  std::vector<std::int64_t> others;  ///< -1 where there is none
  std::vector<double> gaps;

  void append(const Unconnected& found) {
    for (const VertexId v : found.vertices) others.push_back(v == kNoVertex ? -1 : std::int64_t{v});
    gaps.insert(gaps.end(), found.gaps.begin(), found.gaps.end());
  }
};

void write_npz(const std::string& file, const RowQuery& rows, std::size_t scales, const Gaps& found) {
  io::NpzWriter npz(file);
  write_radii(npz, rows.query().radius);
  write_vertices(npz, rows.listed());
  const std::array<std::uint64_t, 2> shape{scales, rows.size()};
  npz.begin<std::int64_t>("other", shape);
  npz.append<std::int64_t>(found.others);
  npz.begin<double>("gap", shape);
  npz.append<double>(found.gaps);
  npz.commit();
}

void write_mesh(const ValueFiles& files, std::size_t scales, const Gaps& found, const MeshView& mesh) {
  const std::size_t rows = mesh.positions.size();
  VertexValues values(rows);
  for (std::size_t i = 0; i < scales; ++i) {
    values.add(fmt::format("gap_{}", i), [&](std::size_t v) { return found.gaps[i * rows + v]; });
  }
  values.write(files, mesh, scales - 1);
}

void unconnected(const UnconnectedCommand& options) {
  check_value_files(options.files);
  Input input(options.file, options.reading, options.rows.threads);
  input.need_edges("unconnected");
  const RowQuery rows(options.rows, input);
  input.ignore_welded();
  const std::size_t scales = options.rows.scale_count();
  const Index& index = input.exact_index(options.rows.threads);
  Gaps found;
  {
    Task task("searching", {"rows", static_cast<double>(scales)});
    for (std::size_t i = 0; i < scales; ++i) {
      found.append(nearest_unconnected(index, rows.query_of_scale(i),
                                       {.threads = options.rows.threads, .progress = task.progress(i, scales)}));
    }
    if (!options.files.npz.empty()) write_npz(options.files.npz, rows, scales, found);
  }
  if (options.files.has_mesh()) write_mesh(options.files, scales, found, input.surface());
  const auto none = static_cast<std::size_t>(std::count(found.others.begin(), found.others.end(), -1));
  Json document = to_json(options.files);
  document.update({{"rows", rows.size()}, {"radii", scales}, {"found", found.others.size() - none}, {"none", none}});
  print_result(options.json, document,
               fmt::format("{}: {} rows, radii: {}; {} with an unconnected vertex, {} without\n",
                           names_of(options.files), rows.size(), scales, found.others.size() - none, none));
}

}  // namespace

void add_unconnected(CLI::App& program) {
  auto options = std::make_shared<UnconnectedCommand>();
  CLI::App* command = program.add_subcommand(
      "unconnected", "Write the nearest vertex of each ball that is not connected in it: gaps and wall thickness");
  add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_rows(*command, options->rows);
  add_metric(*command, options->rows.metric);
  add_value_files(*command, options->files, "the gap at the last radius");
  add_json(*command, options->json);
  command->callback([options] { unconnected(*options); });
}

}  // namespace meshhood::cli
