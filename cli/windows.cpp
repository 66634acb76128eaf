// SPDX-License-Identifier: MIT
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>

#include <fcntl.h>
#include <io.h>
#include <windows.h>
// After windows.h, whose types they use:
#include <shellapi.h>

#include "system.h"

namespace meshhood::cli {

/// The given ones have lost the characters that the code page of the system does not have.
std::vector<std::string> arguments_of(std::span<char* const> /*given*/) {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int i = 1; i < count; ++i) arguments.push_back(std::filesystem::path(words[i]).string());
  ::LocalFree(words);
  return arguments;
}

/// Lines end as they do on other systems, so that a program that reads them need not know this one, and messages are
/// not kept back.
void prepare_streams() {
  ::_setmode(::_fileno(stdout), _O_BINARY);
  ::_setmode(::_fileno(stderr), _O_BINARY);
  std::setvbuf(stderr, nullptr, _IONBF, 0);
  ::SetConsoleOutputCP(CP_UTF8);
}

/// The C library knows no other reason for EINVAL here.
bool is_closed_pipe(int error_number) { return error_number == EPIPE || error_number == EINVAL; }

std::span<const int> ending_signals() {
  static constexpr std::array kSignals{SIGINT, SIGTERM};
  return kSignals;
}

bool is_error_on_terminal() {
  DWORD mode = 0;
  return ::GetConsoleMode(::GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

std::optional<std::size_t> terminal_columns() {
  CONSOLE_SCREEN_BUFFER_INFO console{};
  if (::GetConsoleScreenBufferInfo(::GetStdHandle(STD_OUTPUT_HANDLE), &console) == 0) return std::nullopt;
  return static_cast<std::size_t>(console.srWindow.Right - console.srWindow.Left) + 1;
}

std::string_view open_in_browser(const std::filesystem::path& page) {
  constexpr std::intptr_t kNoError = 32;  // more, by the documentation of ShellExecute
  const HINSTANCE result = ::ShellExecuteW(nullptr, L"open", page.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  return reinterpret_cast<std::intptr_t>(result) > kNoError ? "" : "ShellExecute";
}

}  // namespace meshhood::cli
