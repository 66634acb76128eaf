// SPDX-License-Identifier: MIT
#include <cstddef>
#include <span>

#include "program.h"
#include "system.h"

int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  return meshhood::cli::run_program(meshhood::cli::arguments_of(std::span(argv, static_cast<std::size_t>(argc))));
}
