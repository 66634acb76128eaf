// SPDX-License-Identifier: MIT
// The program: its subcommands, and the exit codes of their errors.
#include <algorithm>
#include <csignal>
#include <exception>
#include <new>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "meshhood/error.h"
#include "meshhood/kernel_target.h"
#include "meshhood/version.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace meshhood::cli {
namespace {

constexpr const char* kDescription =
    "Neighborhoods on polygonal meshes: the connected component of the mesh inside a ball around a vertex,\n"
    "exact and indexed.";

/// Part of the interface of the program.
enum class ExitCode {
  Ok = 0,
  Usage = 2,        ///< a wrong option, vertex or radius
  MeshRefused = 3,  ///< the file is not a valid mesh
  IndexRefused = 4,
  InputOutput = 5,    ///< the operating system could not read or write
  Limit = 6,          ///< a documented limit, the memory or the disk is too small
  Interrupted = 130,  ///< as the shell reports a program that Ctrl-C ended
};

ExitCode exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::VertexOutOfRange:
    case ErrorCode::InvalidRadius:
    case ErrorCode::InvalidOption: return ExitCode::Usage;
    case ErrorCode::InvalidMesh:
    case ErrorCode::MalformedFile:
    case ErrorCode::UnsupportedFormat: return ExitCode::MeshRefused;
    case ErrorCode::MalformedIndex: return ExitCode::IndexRefused;
    case ErrorCode::IoFailure: return ExitCode::InputOutput;
    case ErrorCode::TooLarge: return ExitCode::Limit;
    case ErrorCode::Cancelled: return ExitCode::Interrupted;
  }
  throw std::logic_error("an error code without an exit code");
}

ExitCode fail(ExitCode code, std::string_view message) {
  print_error("", message);
  return code;
}

void add_subcommands(CLI::App& program) {
  program.require_subcommand(0, 1);
  program.set_version_flag("--version", fmt::format("meshhood {}, kernels for {}", kVersion, kernel_target()));
  add_info(program);
  add_build(program);
  add_check(program);
  add_query(program);
  add_connect(program);
  add_region(program);
  add_batch(program);
  add_aggregate(program);
  add_curvature(program);
  add_features(program);
  add_merge(program);
  add_partition(program);
  add_compare(program);
  add_generate(program);
  add_view(program);
}

/// CLI11 takes the next argument as the value of `--radius=`, which a shell makes of an unset variable.
void refuse_empty_values(std::span<const char* const> arguments) {
  for (const std::string_view argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--") || argument.find('=') != argument.size() - 1) continue;
    raise(ErrorCode::InvalidOption, fmt::format("{}: the value is empty", argument.substr(0, argument.size() - 1)));
  }
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The first argument that no command or option accepts, with a suggestion; "" if there is none.
std::string unknown_argument(const CLI::App& program) {
  const std::vector<CLI::App*> commands = program.get_subcommands();
  const CLI::App& command = commands.empty() ? program : *commands.front();
  for (const std::string& argument : command.remaining()) {
    const bool is_option = argument.starts_with('-');
    if (!is_option && &command != &program) continue;
    std::vector<std::string> candidates = names_of_options(command);
    if (!is_option) {
      for (const CLI::App* known : program.get_subcommands({})) candidates.push_back(known->get_name());
    }
    const std::string name = argument.substr(0, argument.find('='));
    return fmt::format("unknown {} '{}'{}", is_option ? "option" : "command", name, suggestion(name, candidates));
  }
  return {};
}

/// Runs the subcommand, or prints the help or the version if that was requested.
void run(CLI::App& program, int argc, const char* const* argv) {
  try {
    refuse_empty_values(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) raise(ErrorCode::InvalidOption, "a command is missing; see --help");
  } catch (const CLI::Success& request) {
    std::ostringstream text;
    program.exit(request, text, text);
    print_text(text.str());
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_argument(program);
    raise(ErrorCode::InvalidOption, unknown.empty() ? error.what() : unknown);
  }
  close_output();
}

ExitCode run_or_report(int argc, const char* const* argv) {
  try {
    CLI::App program(kDescription, "meshhood");
    add_subcommands(program);
    run(program, argc, argv);
    return ExitCode::Ok;
  } catch (const OutputClosed&) {
    return ExitCode::Ok;
  } catch (const Error& error) {
    return fail(exit_code(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::Limit, "not enough memory");
  } catch (const std::length_error&) {
    return fail(ExitCode::Limit, "not enough memory");
  } catch (const std::system_error& error) {
    return fail(ExitCode::InputOutput, error.what());
  }
}

/// A file opened later must not get the number of a closed standard stream: messages would be written into it. Writing
/// to a closed standard output still fails, because the replacement is opened in the wrong direction.
void occupy_standard_streams() {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    if (::fcntl(number, F_GETFD) != -1) continue;
    static_cast<void>(::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

}  // namespace
}  // namespace meshhood::cli

// An exception that escapes is a bug, or there is not enough memory for an error message.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  meshhood::cli::occupy_standard_streams();
  // Both become errors of the write: a closed pipe, and a file-size limit for standard output.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(meshhood::cli::run_or_report(argc, argv));
}
