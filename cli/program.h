// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace meshhood::cli {

/// The program as a function: runs the command that `arguments` name, without the name of the program, and returns its
/// exit code, an error of the command included. Once in a process, which should then end: standard output is closed,
/// and SIGPIPE and SIGXFSZ stay ignored. An exception is a bug, or there is not enough memory for an error message.
[[nodiscard]] int run_program(std::span<const char* const> arguments);

}  // namespace meshhood::cli
