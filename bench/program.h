// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <limits>
#include <string>
#include <vector>

namespace meshhood::bench {

/// The exit status of the program `name`: what `run()` returns, or 1 after printing the exception that it throws.
template <class Run>
int exit_status(const std::string& name, const Run& run) {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return 1;
  }
}

using Arguments = std::vector<std::string>;  ///< without the name of the program

/// How a program is called.
struct Usage {
  std::string words;  ///< its name and its arguments
  std::size_t least;  ///< how many arguments it needs
  std::size_t most = std::numeric_limits<std::size_t>::max();
};

/// The exit status of a program: that of `run(arguments)`, or 2 after printing the usage.
template <class Run>
int run_program(int argc, char** argv, const Usage& usage, const Run& run) {
  const Arguments arguments(argv + 1, argv + argc);
  if (arguments.size() < usage.least || arguments.size() > usage.most) {
    std::fprintf(stderr, "usage: %s\n", usage.words.c_str());
    return 2;
  }
  return exit_status(usage.words.substr(0, usage.words.find(' ')), [&] { return run(arguments); });
}

/// The arguments from the place `first` on; `otherwise` if there are none.
inline std::vector<double> numbers(const Arguments& arguments, std::size_t first, std::vector<double> otherwise = {}) {
  if (arguments.size() > first) otherwise.clear();
  for (std::size_t i = first; i < arguments.size(); ++i) otherwise.push_back(std::stod(arguments[i]));
  return otherwise;
}

}  // namespace meshhood::bench
