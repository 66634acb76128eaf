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
  add_choice(command, "--metric",
             "of the radius; straight: distances in a straight line; path: lengths of the shortest paths along the "
             "edges; rings: numbers of edges",
             {"straight", "path", "rings"}, options.metric);
}

void add_metric(CLI::App& command, std::string& metric) {
  add_choice(command, "--metric",
             "of the radius; straight: distances in a straight line; path: lengths of the shortest paths along the "
             "edges",
             {"straight", "path"}, metric);
}

void check_method(const MethodOptions& options, bool has_filter, const std::string& unit) {
  if (options.method != "exact" && (!options.is_straight() || has_filter)) {
    raise(ErrorCode::InvalidOption, "--metric, --walls and --ignored require --method exact");
  }
  if (options.metric == "rings" && unit != "mesh") {
    raise(ErrorCode::InvalidOption, "--metric rings: expected --unit mesh, because the radius is a number of edges");
  }
}

SearchMethod method_of(const MethodOptions& options, Input& input, const paper::QueryOptions& settings,
                       unsigned threads) {
  const std::string& name = options.method;
  if (!options.is_straight()) input.need_edges("--metric " + options.metric);
  if (name == "exact" || name == "bfs") input.need_edges("--method " + name);
  if (name == "bfs") return SearchMethod::breadth_first(input.graph());
  if (name == "ball") return SearchMethod::ball_scan(input.positions());
  if (name == "paper") return {input.paper_index(), settings};
  const Index& index = input.exact_index(threads);
  if (options.metric == "path") return SearchMethod::along_edges(index);
  if (options.metric == "rings") return SearchMethod::rings(index);
  return index;
}

}  // namespace meshhood::cli
