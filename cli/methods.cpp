// SPDX-License-Identifier: MIT
#include "methods.h"

#include <string>

#include "meshhood/error.h"

#include "options.h"

namespace meshhood::cli {

void add_method(CLI::App& command, MethodOptions& options) {
  add_choice(command, "--method",
             "exact: by the index; bfs: exact by breadth-first search, slower; paper: with a few extra vertices; ball: "
             "all vertices in the ball",
             {"exact", "bfs", "paper", "ball"}, options.method);
  add_metric(command, options.metric);
}

void add_metric(CLI::App& command, std::string& metric) {
  add_choice(command, "--metric",
             "of the radius; straight: distances in a straight line; path: lengths of the shortest paths along the "
             "edges; rings: numbers of edges; space: all vertices in the ball, connected or not",
             names_of(kMetrics), metric);
}

Metric checked_metric(const std::string& name, const std::string& unit) {
  if (name == "rings" && unit != "mesh") {
    raise(ErrorCode::InvalidOption, "--metric rings: expected --unit mesh, because the radius is a number of edges");
  }
  return value_of(kMetrics, name);
}

void check_method(const MethodOptions& options, bool has_masks, const std::string& unit) {
  if (options.method != "exact" && (!options.is_straight() || has_masks)) {
    raise(ErrorCode::InvalidOption, "--metric, --walls and --ignored require --method exact");
  }
  static_cast<void>(checked_metric(options.metric, unit));
}

SearchMethod method_of(const MethodOptions& options, Input& input, const paper::QueryOptions& settings,
                       unsigned threads) {
  const std::string& name = options.method;
  if (!options.is_straight()) input.need_edges("--metric " + options.metric);
  if (name == "exact" || name == "bfs") input.need_edges("--method " + name);
  if (name == "bfs") return SearchMethod::breadth_first(input.graph());
  if (name == "ball") return SearchMethod::ball_scan(input.positions());
  if (name == "paper") return {input.paper_index(), settings};
  return input.exact_index(threads);
}

}  // namespace meshhood::cli
