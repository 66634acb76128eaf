// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <span>

#include "program.h"

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
  return meshhood::cli::run_program(arguments.subspan(std::min<std::size_t>(1, arguments.size())));
}
