// SPDX-License-Identifier: MIT
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <io.h>
#include <windows.h>
// After windows.h, whose types it uses:
#include <shellapi.h>

#include "system.h"

namespace meshhood::cli {
namespace {

/// What is not UTF-16 becomes U+FFFD, so that a file of such a name is not found.
std::string in_utf8(std::wstring_view word) {
  const auto size = static_cast<int>(word.size());
  std::string text(3 * word.size(), '\0');  // the most that it can take
  const int count = ::WideCharToMultiByte(CP_UTF8, 0, word.data(), size, text.data(), static_cast<int>(text.size()),
                                          nullptr, nullptr);
  text.resize(static_cast<std::size_t>(count));
  return text;
}

}  // namespace

/// The given ones have lost the characters that the code page of the system does not have.
std::vector<std::string> arguments_of(std::span<char* const> /*given*/) {
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int i = 1; i < count; ++i) arguments.push_back(in_utf8(words[i]));
  ::LocalFree(words);
  return arguments;
}

/// Lines end as they do on other systems, so that a program that reads them need not know this one, and messages are
/// not kept back. The console shows UTF-8 as long as the program runs.
void prepare_streams() {
  ::_setmode(::_fileno(stdout), _O_BINARY);
  ::_setmode(::_fileno(stderr), _O_BINARY);
  std::setvbuf(stderr, nullptr, _IONBF, 0);
  static const UINT code_page = ::GetConsoleOutputCP();
  if (::SetConsoleOutputCP(CP_UTF8) != 0) std::atexit([] { ::SetConsoleOutputCP(code_page); });
}

/// The C library has EINVAL for a pipe that its reader has closed, and for all errors that it does not know.
bool is_closed_pipe(int error_number) {
  return error_number == EPIPE ||
         (error_number == EINVAL && ::GetFileType(::GetStdHandle(STD_OUTPUT_HANDLE)) == FILE_TYPE_PIPE);
}

std::span<const int> ending_signals() {
  static constexpr std::array kSignals{SIGINT, SIGBREAK};
  return kSignals;
}

/// Of which a line can be cleared by an escape sequence.
bool shows_messages_on_terminal() {
  const HANDLE messages = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(messages, &mode) != 0 &&
         ::SetConsoleMode(messages, mode | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
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
