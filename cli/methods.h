// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"
#include "meshhood/paper.h"

#include "input.h"

/// The methods of a search by their names: exact, bfs, paper and ball.
namespace meshhood::cli {

/// --method.
void add_method(CLI::App& command, std::string& method);

/// The method `name`. Borrows `input`. `options` are those of paper; `threads` build the index. Throws
/// Error{InvalidOption} if the method needs edges and the input has none.
[[nodiscard]] SearchMethod method_of(const std::string& name, Input& input, const paper::QueryOptions& options = {},
                                     unsigned threads = kAllThreads);

}  // namespace meshhood::cli
