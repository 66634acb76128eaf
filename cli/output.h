// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshhood/error.h"

#include "io/messages.h"

/// Results go to standard output, everything else to standard error. If a file is written to standard output (`-o -`),
/// it is the result, and text goes to standard error.
namespace meshhood::cli {

/// Keeps the order of its keys.
using Json = nlohmann::ordered_json;

using io::printable_name;

/// From now on, `print_text` writes to standard error.
void keep_standard_output_for_file();

/// Writes `text` to standard output and flushes. Throws Error{IoFailure}; of EPIPE and `io::kStandardOutput` if its
/// reader has closed it, as `head` does: the program then ends quietly.
void print_text(std::string_view text);

/// Prints the JSON document of a `--json` run. Bytes that are not UTF-8 become U+FFFD.
void print_json(const Json& document);

/// Prints the result of a command: `document` in a `--json` run, otherwise `text`.
void print_result(bool json, const Json& document, std::string_view text);

/// Throws Error{InvalidOption}. The text names what is at fault, its value and what was expected.
template <class... Parts>
[[noreturn]] void wrong_option(fmt::format_string<Parts...> text, Parts&&... parts) {
  raise(ErrorCode::InvalidOption, fmt::format(text, std::forward<Parts>(parts)...));
}

/// Closes standard output: some file systems report errors only then. Throws as `print_text`.
void close_output();

/// Prints one line on standard error: "meshhood: " + `severity` + `text`. `severity` is "" for an error, otherwise
/// "warning: " or "note: ".
void print_error(std::string_view severity, std::string_view text);

/// "1.76 GB", with a unit of powers of 1000. JSON has numbers in full.
[[nodiscard]] std::string bytes_text(double bytes, int digits = 3);

}  // namespace meshhood::cli
