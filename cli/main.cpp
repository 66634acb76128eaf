// SPDX-License-Identifier: MIT
// The program: its subcommands, and what becomes of their errors.
#include <csignal>
#include <exception>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/error.h"
#include "meshhood/version.h"

#include "commands.h"
#include "exit_code.h"
#include "output.h"

namespace meshhood::cli {
namespace {

constexpr const char* kDescription =
    "The neighborhood of a point on a polygonal mesh: what lies within a distance of it in space and is\n"
    "joined to it along the surface within that distance.";

void add_subcommands(CLI::App& program) {
  program.require_subcommand(0, 1);
  program.set_version_flag("--version", "meshhood " + std::string(kVersion));
  add_info(program);
  add_build(program);
  add_check(program);
  add_query(program);
  add_batch(program);
  add_compare(program);
  add_bench(program);
  add_generate(program);
}

/// Runs the subcommand, or prints the help or the version where these were asked for.
void run(CLI::App& program, int argc, const char* const* argv) {
  try {
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) raise(ErrorCode::InvalidOption, "a subcommand is missing; see --help");
  } catch (const CLI::Success& request) {
    std::ostringstream text;
    program.exit(request, text, text);
    print_text(text.str());
  }
  close_output();
}

ExitCode run_or_complain(int argc, const char* const* argv) {
  try {
    CLI::App program(kDescription, "meshhood");
    add_subcommands(program);
    run(program, argc, argv);
    return ExitCode::Ok;
  } catch (const BrokenPipe&) {
    return ExitCode::InputOutput;
  } catch (const CLI::ParseError& error) {
    print_error("", error.what());
    return ExitCode::Usage;
  } catch (const std::exception& error) {
    const ExitCode code = exit_code(error);
    print_error("", reason(error));
    return code;
  }
}

}  // namespace
}  // namespace meshhood::cli

// What still escapes is a bug, or memory too short for an error message.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  // A reader that has gone is an error of `print_text`, not a signal.
  std::signal(SIGPIPE, SIG_IGN);
  return static_cast<int>(meshhood::cli::run_or_complain(argc, argv));
}
