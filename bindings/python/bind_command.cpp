// SPDX-License-Identifier: MIT
#include <csignal>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "cli/program.h"
#include "interpreter.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// As the program would find it: Python raises an exception at Ctrl-C, unless the signal was ignored at the start.
void restore_interrupt() {
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

int run_command(const std::vector<nb::bytes>& words) {
  std::vector<const char*> arguments;
  for (const nb::bytes& word : words) arguments.push_back(word.c_str());
  restore_interrupt();
  return without_lock([&] { return cli::run_program(arguments); });
}

}  // namespace

void bind_command(nb::module_& module) { module.def("run_command", run_command); }

}  // namespace meshhood::python
