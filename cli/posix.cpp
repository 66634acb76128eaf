// SPDX-License-Identifier: MIT
#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "system.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): not every system declares it

namespace meshhood::cli {

std::vector<std::string> arguments_of(std::span<char* const> given) {
  return {given.begin() + (given.empty() ? 0 : 1), given.end()};
}

/// Writing to a closed standard output still fails, because its replacement is opened in the wrong direction.
void prepare_streams() {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    if (::fcntl(number, F_GETFD) != -1) continue;
    static_cast<void>(::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_closed_pipe(int error_number) { return error_number == EPIPE; }

std::span<const int> ending_signals() {
  static constexpr std::array kSignals{SIGINT, SIGHUP, SIGTERM, SIGXCPU};
  return kSignals;
}

bool shows_messages_on_terminal() { return ::isatty(STDERR_FILENO) != 0; }

std::optional<std::size_t> terminal_columns() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

std::string_view open_in_browser(const std::filesystem::path& page) {
#if defined(__APPLE__)
  constexpr std::string_view kProgram = "open";
#else
  constexpr std::string_view kProgram = "xdg-open";
#endif
  std::string program(kProgram);
  std::string argument = page.string();
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments.data(), environ);
  int status = 0;
  return error == 0 && ::waitpid(process, &status, 0) == process && status == 0 ? "" : kProgram;
}

}  // namespace meshhood::cli
