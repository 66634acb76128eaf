// SPDX-License-Identifier: MIT
#include "methods.h"

#include <string>
#include <utility>
#include <vector>

#include "meshhood/surface.h"

#include "output.h"

namespace meshhood::cli {

void add_method(CLI::App& command, MethodOptions& options) {
  add_choice(command, "--method",
             "exact: by the index; bfs: exact by breadth-first search, slower; paper: with a few extra vertices; ball: "
             "all vertices in the ball",
             {"exact", "bfs", "paper", "ball"}, options.method);
  add_metric(command, options.metric);
  add_choice(command, "--sort",
             "order of the vertices of an answer: id, index (that of the index, the fastest) or distance, then id",
             names_of(kSorts), options.sort);
}

void add_metric(CLI::App& command, std::string& metric, bool takes_space) {
  std::vector<std::string> names = names_of(kMetrics);
  if (!takes_space) std::erase(names, "space");
  add_choice(command, "--metric",
             std::string("of the radius; straight: distances in a straight line; path: lengths of the shortest paths "
                         "along the edges; surface: along edges and over pairs of triangles; rings: numbers of edges") +
                 (takes_space ? "; space: all vertices in the ball, connected or not" : ""),
             std::move(names), metric);
}

Metric choose_metric(const std::string& name, Input& input) {
  if (name == "rings" && input.plan() != nullptr) {
    wrong_option("--metric rings: {} is the index of a part, whose halo is a length, expected another metric",
                 printable_name(input.name()));
  }
  if (name == "surface") {
    input.need_faces("--metric surface");
    input.change_index([&input](const Index& index, unsigned threads) {
      return surface_paths(Surface(index, input.surface()), {.threads = threads});
    });
  }
  return value_of(kMetrics, name);
}

Searcher make_searcher(const std::string& metric, Input& input) {
  const Metric chosen = choose_metric(metric, input);
  return Searcher(input.exact_index(), chosen);
}

void check_metric(const std::string& name, const std::string& unit) {
  if (name == "rings" && unit != "mesh") {
    wrong_option("--metric rings: expected --unit mesh, because the radius is a number of edges");
  }
}

void check_method(const MethodOptions& options, const Reading& reading, bool has_masks, const std::string& unit) {
  const bool is_exact = options.method == "exact";
  if (!is_exact && !options.is_straight()) wrong_option("--metric requires --method exact");
  if (!is_exact && options.method != "ball" && has_masks) {
    wrong_option("--walls and --ignored require --method exact or ball");
  }
  check_metric(options.metric, unit);
  if (options.sort == "index" && !is_exact) wrong_option("--sort index: expected --method exact");
  if (options.method == "ball" && !reading.weld.empty()) {
    wrong_option(
        "--weld: expected another --method than ball, which knows no faces, so that welding has no effect on it");
  }
}

SearchMethod method_of(const MethodOptions& options, Input& input, const paper::QueryOptions& settings,
                       unsigned threads) {
  const std::string& name = options.method;
  if (!options.is_straight()) input.need_edges("--metric " + options.metric);
  const bool is_by_index = name == "exact" || (name == "ball" && input.has_masks());  // a scan knows no masks
  if (is_by_index || name == "bfs") input.need_edges("--method " + name);
  if (!is_by_index) input.need_positions("--method " + name);
  if (name == "bfs") return SearchMethod::breadth_first(input.graph());
  if (name == "ball" && is_by_index) return SearchMethod(input.exact_index(threads)).by(Metric::Space);
  if (name == "ball") return SearchMethod::ball_scan(input.positions());
  if (name == "paper") return {input.paper_index(), settings};
  return input.exact_index(threads);
}

RowOrder row_order(const std::string& sort, Input& input) {
  return sort == "index" ? RowOrder(input.exact_index().permutation()) : RowOrder(value_of(kSorts, sort));
}

}  // namespace meshhood::cli
