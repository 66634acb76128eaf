// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace meshhood::cli {

/// Where a figure was measured, for it means nothing without.
struct Machine {
  std::string processor;
  std::string compiler;
  std::string build;  ///< "Release", ...
};

[[nodiscard]] Machine this_machine();

}  // namespace meshhood::cli
