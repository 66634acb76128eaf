// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

/// Results on standard output, everything else on standard error.
namespace meshhood::cli {

/// Keeps its keys in the order they were given.
using Json = nlohmann::ordered_json;

/// Thrown where the reader of standard output has gone. No one is left to print_error to.
struct BrokenPipe {};

/// Writes all of `text` to standard output, past every buffer. Throws Error{IoFailure}, BrokenPipe.
void print_text(std::string_view text);

/// The one JSON document of a `--json` run. Bytes of a file name that are not UTF-8 become U+FFFD.
void print_json(const Json& document);

/// Closes standard output, for some file systems tell only then that they could not write. Throws as `print_text`.
void close_output();

/// `text` on one line: control characters, which could also steer a terminal, are written as `\x0a`.
[[nodiscard]] std::string printable(std::string_view text);

/// A table of two columns as text: names, filled up to one width, and what stands beside them.
class Rows {
 public:
  explicit Rows(std::size_t width) : width_(width) {}

  void add(std::string_view name, std::string_view value);
  void add(std::string_view name, std::uint64_t value) { add(name, std::to_string(value)); }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::size_t width_;
  std::string text_;
};

/// One line on standard error. `severity` is "" for an error, "warning: " for less.
void print_error(std::string_view severity, std::string_view text);

}  // namespace meshhood::cli
