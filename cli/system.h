// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the program needs of the operating system beside files: by POSIX in posix.cpp, on Windows in windows.cpp.
namespace meshhood::cli {

/// The arguments of the program in UTF-8, without its name.
[[nodiscard]] std::vector<std::string> arguments_of(std::span<char* const> given);

/// The file of a name in UTF-8. A path that is made of the name itself would have another on Windows.
[[nodiscard]] inline std::filesystem::path path_of(std::string_view name) {
  return std::u8string(name.begin(), name.end());
}

/// Before the first file is opened: it must not get the number of a closed standard stream, as messages would be
/// written into it. A closed pipe, and a file-size limit for standard output, become errors of the write.
void prepare_streams();

/// Whether a write to standard output failed because its reader has closed it.
[[nodiscard]] bool is_closed_pipe(int error_number);

/// The signals by which the user or the system ends a program.
[[nodiscard]] std::span<const int> ending_signals();

/// Whether standard error is a terminal.
[[nodiscard]] bool shows_messages_on_terminal();

/// Of the terminal that shows standard output, if there is one.
[[nodiscard]] std::optional<std::size_t> terminal_columns();

/// Starts the browser that the desktop prefers. Returns the program that could not open the page, or "".
[[nodiscard]] std::string_view open_in_browser(const std::filesystem::path& page);

}  // namespace meshhood::cli
