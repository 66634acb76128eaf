// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meshhood::cli {

/// A mesh file of another library.
struct OtherFile {
  std::string ply;                 ///< its content as PLY
  std::vector<std::string> notes;  ///< what there is to say of it, vertices without a position included
};

/// Reads a mesh file whose format `io::read_mesh` refuses; nothing if `file` is none that it knows. Throws Error.
using OtherReader = std::function<std::optional<OtherFile>(const std::string& file)>;

/// Sets what reads the files that `io::read_mesh` refuses. Before the first command.
void read_others_by(OtherReader reader);

/// The program as a function: runs the command that `arguments` name, without the name of the program, and returns its
/// exit code, an error of the command included. Once in a process, which should then end: standard output is closed,
/// and SIGPIPE and SIGXFSZ stay ignored. An exception is a bug, or there is not enough memory for an error message.
[[nodiscard]] int run_program(std::vector<std::string> arguments);

}  // namespace meshhood::cli
