// SPDX-License-Identifier: MIT
#include "methods.h"

#include <string>

#include "options.h"

namespace meshhood::cli {
namespace {

void check_edges(const std::string& name, const Input& input) {
  if (name == "exact" || name == "bfs") input.need_edges("--method " + name);
}

}  // namespace

void add_method(CLI::App& command, std::string& method) {
  add_choice(command, "--method",
             "exact: by the index; bfs: exact by breadth-first search, slower; paper: with a few extra vertices; ball: "
             "all vertices in the ball",
             {"exact", "bfs", "paper", "ball"}, method);
}

SearchMethod method_of(const std::string& name, Input& input, const paper::QueryOptions& options, unsigned threads) {
  check_edges(name, input);
  if (name == "bfs") return SearchMethod::breadth_first(input.graph());
  if (name == "ball") return SearchMethod::ball_scan(input.positions());
  if (name == "paper") return {input.paper_index(), options};
  return input.exact_index(threads);
}

}  // namespace meshhood::cli
