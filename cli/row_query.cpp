// SPDX-License-Identifier: MIT
#include "row_query.h"

#include <utility>

namespace meshhood::cli {

std::vector<std::string> RowOptions::with_files(std::vector<std::string> files) const {
  files.insert(files.end(), {vertices, filter.walls, filter.ignored});
  return files;
}

CLI::Option* add_rows(CLI::App& command, RowOptions& options) {
  CLI::Option* const radius = add_radii(command, options.radii);
  add_vertices(command, options.vertices);
  add_filter(command, options.filter);
  add_threads(command, options.threads);
  return radius;
}

RowQuery::RowQuery(const RowOptions& options, Input& input)
    : radii_(resolve(options.radii, input)),
      vertices_(options.vertices, input),
      masks_(options.filter, input),
      size_(row_count(vertices_.view(), input.vertex_count())) {}

BatchQuery RowQuery::query(BatchRadius radius) const {
  return {.vertices = vertices_.view(), .radius = std::move(radius), .filter = masks_.filter()};
}

}  // namespace meshhood::cli
