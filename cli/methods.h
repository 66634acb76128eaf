// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"
#include "meshhood/paper.h"

#include "input.h"
#include "measure/methods.h"

/// The methods of a search by their names: exact, bfs, paper and ball.
namespace meshhood::cli {

/// --method.
void add_method(CLI::App& command, std::string& method);

/// The method `name` for single queries. Borrows `input`. Throws Error{InvalidOption} if it needs edges and the input
/// has none.
[[nodiscard]] measure::Method single_method(const std::string& name, Input& input, const paper::QueryOptions& options);

/// The same for a batch. `threads` build the index.
[[nodiscard]] SearchMethod batch_method(const std::string& name, Input& input, unsigned threads);

}  // namespace meshhood::cli
