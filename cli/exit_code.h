// SPDX-License-Identifier: MIT
#pragma once

#include <exception>

namespace meshhood::cli {

/// What the program says to the shell. The numbers are part of its interface.
enum class ExitCode {
  Ok = 0,
  Usage = 2,        ///< an option, a vertex or a radius that cannot be
  MeshRefused = 3,  ///< a file that is no mesh
  IndexRefused = 4,
  InputOutput = 5,    ///< the operating system could not read or write
  Limit = 6,          ///< too large for the documented limits or for the memory
  Interrupted = 130,  ///< as the shell says it of a program that Ctrl-C ended
};

/// The code for an error that ended a command. Rethrows what is no known error, for it would be a bug.
[[nodiscard]] ExitCode exit_code(const std::exception& error);

/// What to tell of it, in one line.
[[nodiscard]] const char* reason(const std::exception& error);

}  // namespace meshhood::cli
