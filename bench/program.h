// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <exception>

namespace meshhood::bench {

/// The exit status of the program `name`: what `run()` returns, or 1 after printing the exception that it throws.
template <class Run>
int exit_status(const char* name, const Run& run) {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace meshhood::bench
