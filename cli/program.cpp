// SPDX-License-Identifier: MIT
#include "program.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/error.h"
#include "meshhood/kernel_target.h"
#include "meshhood/version.h"

#include "commands.h"
#include "io/number.h"
#include "io/system.h"
#include "options.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {
namespace {

constexpr const char* kDescription =
    "Neighborhoods on polygonal meshes: the connected component of the mesh inside a ball around a vertex, exact and "
    "indexed.";

constexpr const char* kFooter =
    "FILE may be - for standard input, except of partition and view, and --output - is standard output, except of "
    "partition; what is printed then goes to standard error.\n"
    "Exit codes: 0 done, 2 wrong usage, 3 not a valid mesh, 4 not a valid index, 5 failed to read or write, 6 a limit, "
    "the memory or the disk is too small, 130 interrupted.";

std::size_t terminal_width() {
  constexpr std::size_t kDefault = 80;
  constexpr std::size_t kLeast = 60;                // for a column of names and one of words
  const char* const text = std::getenv("COLUMNS");  // NOLINT(concurrency-mt-unsafe): no thread sets it
  const std::optional<std::uint64_t> columns = text == nullptr ? std::nullopt : io::parse_count(text);
  if (columns && *columns > 0) return std::max<std::size_t>(*columns, kLeast);
  return std::max(terminal_columns().value_or(kDefault), kLeast);
}

/// Breaks lines at blanks. A longer word keeps its length.
std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    if (line > 0 && line + 1 + end > width) {
      result += '\n';
      line = 0;
    }
    if (line > 0) result += ' ';
    line += end + (line > 0 ? 1 : 0);
    result += text.substr(0, end);
    if (end < text.size() && text[end] == '\n') {
      result += '\n';
      line = 0;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

/// The help of CLI11, wrapped to the terminal: to COLUMNS if it is set, to the width of the terminal on standard
/// output, or else to 80 characters.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    return in_column(CLI::Formatter::make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    const std::size_t width = get_column_width();
    const std::string margin = fmt::format("\n{:{}}", "", width);
    std::string line = fmt::format("{:{}}", "  " + command->get_display_name(true), width);
    if (line.size() > width) line += margin;
    for (const char c : in_column(command->get_description())) c == '\n' ? line += margin : line += c;
    return line + '\n';
  }

  std::string make_description(const CLI::App* command) const override {
    return wrapped(CLI::Formatter::make_description(command), width_);
  }

  std::string make_footer(const CLI::App* command) const override {
    return wrapped(CLI::Formatter::make_footer(command), width_);
  }

 private:
  [[nodiscard]] std::string in_column(const std::string& text) const {
    return wrapped(text, width_ - get_column_width());
  }

  std::size_t width_ = terminal_width();
};

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
  program.allow_windows_style_options(false);  // on Windows, /name would be an option; the commands inherit it
  program.formatter(std::make_shared<HelpFormatter>());  // the commands inherit it
  program.group("Subcommands");                          // and this; versions of CLI11 differ
  program.footer(kFooter);
  program.set_version_flag("--version", fmt::format("meshhood {}, kernels for {}", kVersion, kernel_target()));
  add_commands(program);
}

/// CLI11 takes the next argument as the value of `--radius=`, which a shell makes of an unset variable.
void refuse_empty_values(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") return;
    if (!argument.starts_with("--") || argument.find('=') != argument.size() - 1) continue;
    wrong_option("{}: the value is empty", argument.substr(0, argument.size() - 1));
  }
}

bool are_numbers(std::span<const std::string> words) {
  return std::all_of(words.begin(), words.end(), [](const std::string& word) { return io::parse_real<double>(word); });
}

/// Turns `--point X Y Z` into `--point X,Y,Z`, as an option of CLI11 with one to three values would also take the FILE
/// that follows `--point X,Y,Z`; and `--weld EPS` into `--weld=EPS`, as a flag of CLI11 takes no value after a blank.
/// `--weld` alone becomes `--weld=0`: CLI11 would store the word true. A FILE whose name is a number is given as ./7.
void join_values(std::vector<std::string>& arguments) {
  constexpr std::size_t kAxes = 3;
  std::vector<std::string> joined;
  for (std::span<const std::string> rest = arguments; !rest.empty();) {
    const std::string& name = rest.front();
    rest = rest.subspan(1);
    joined.push_back(name);
    if (name == "--") {
      joined.insert(joined.end(), rest.begin(), rest.end());
      break;
    }
    if (name == "--point" && rest.size() >= kAxes && are_numbers(rest.first(kAxes))) {
      joined.push_back(fmt::format("{}", fmt::join(rest.first(kAxes), ",")));
      rest = rest.subspan(kAxes);
    } else if (name == "--weld") {
      const bool has_eps = !rest.empty() && are_numbers(rest.first(1));
      joined.back() += '=' + (has_eps ? rest.front() : "0");
      if (has_eps) rest = rest.subspan(1);
    }
  }
  arguments = std::move(joined);
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Where to find what other programs call `name`.
std::string command_for(std::string_view name) {
  if (name == "stats" || name == "stat" || name == "statistics") return "; did you mean 'info'?";
  return "; meshhood --help prints all";
}

/// The first argument that no command or option accepts, with a suggestion; "" if there is none.
std::string unknown_argument(const CLI::App& program) {
  const std::vector<CLI::App*> commands = program.get_subcommands();
  const CLI::App& command = commands.empty() ? program : *commands.front();
  for (const std::string& argument : command.remaining()) {
    const bool is_option = argument.starts_with('-');
    if (argument == "--" || (!is_option && &command != &program)) continue;
    std::vector<std::string> candidates = names_of_options(command);
    if (!is_option) {
      for (const CLI::App* known : program.get_subcommands({})) candidates.push_back(known->get_name());
    }
    const std::string name = argument.substr(0, argument.find('='));
    if (is_option) return fmt::format("unknown option '{}'{}", name, suggestion(name, candidates));
    const std::string similar = suggestion(name, candidates);
    return fmt::format("unknown command '{}'{}", name, similar.empty() ? command_for(name) : similar);
  }
  return {};
}

/// Runs the subcommand, or prints the help or the version if that was requested.
void run(CLI::App& program, std::vector<std::string> arguments) {
  try {
    refuse_empty_values(arguments);
    join_values(arguments);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    program.parse(std::move(arguments));
    if (program.get_subcommands().empty()) wrong_option("a command is missing; see --help");
  } catch (const CLI::Success& request) {
    const std::string unknown = program.get_subcommands().empty() ? unknown_argument(program) : "";
    if (!unknown.empty()) raise(ErrorCode::InvalidOption, unknown);
    std::ostringstream text;
    program.exit(request, text, text);
    print_text(text.str());
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_argument(program);
    raise(ErrorCode::InvalidOption, unknown.empty() ? error.what() : unknown);
  }
  close_output();
}

ExitCode run_or_report(std::vector<std::string> arguments) {
  try {
    CLI::App program(kDescription, "meshhood");
    add_subcommands(program);
    run(program, std::move(arguments));
    return ExitCode::Ok;
  } catch (const Error& error) {
    if (error.path() == io::kStandardOutput && error.error_number() == EPIPE) return ExitCode::Ok;
    return fail(exit_code(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::Limit, "not enough memory");
  } catch (const std::length_error&) {
    return fail(ExitCode::Limit, "not enough memory");
  } catch (const std::system_error& error) {
    return fail(ExitCode::InputOutput, error.what());
  }
}

}  // namespace

int run_program(std::vector<std::string> arguments) {
  prepare_streams();
  return static_cast<int>(run_or_report(std::move(arguments)));
}

}  // namespace meshhood::cli
