// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/input_buffer.h"
#include "io/messages.h"

namespace meshhood::inline v0_1::io {

/// With a to z in place of A to Z, whatever the locale.
[[nodiscard]] std::string lower_case(std::string text);

/// What separates tokens: blanks in a line, and line ends.
inline constexpr std::string_view kBlanks = " \t\v\f\r\n";

/// Skips the byte-order mark of UTF-8. Throws Error{UnsupportedFormat} for one of UTF-16.
void take_byte_order_mark(InputBuffer& input);

inline constexpr char kAnyLineEnd = 0;

/// The lexical rules of a text format.
struct TextSyntax {
  bool hash_comments = false;      ///< `#` at the start of a token makes the rest of the line a comment
  char line_end = kAnyLineEnd;     ///< the byte that ends a line, or any of LF, CR and CRLF
  std::uint64_t lines_before = 0;  ///< number of lines before the text
};

/// Splits a text file into lines and tokens. Blanks, tabs, vertical tabs and form feeds separate tokens. A line has at
/// most 64 MiB.
class Text {
 public:
  /// Starts before the line at the front of `input`.
  Text(InputBuffer& input, const TextSyntax& syntax)
      : input_(input), syntax_(syntax), line_number_(syntax.lines_before) {}

  /// Moves to the next line; false at the end of the file. Throws Error{MalformedFile} for a NUL byte and for a line
  /// that is too long.
  bool next_line();

  /// The next token of this line; empty at its end.
  std::string_view token_on_line();

  /// The next token of this or a later line; empty at the end of the file.
  std::string_view token();

  /// Makes the last token the next one again.
  void put_back() { cursor_ = std::min(token_begin_, line_.size()); }

  void skip_line() { cursor_ = line_.size(); }

  /// Leaves the current line behind: the next one is at the front of the input.
  void finish_line() {
    skip_line();
    leave_line();
  }

  /// Moves to the end of the last of `lines` lines, which have `bytes` bytes and are at the front of the input.
  void skip_lines(std::size_t bytes, std::uint64_t lines);

  /// Moves the input past the current line and its end.
  void leave_line() { input_.skip(std::exchange(whole_length_, 0)); }

  /// Whether this line holds no further token.
  [[nodiscard]] bool at_line_end() const;

  /// The text from the start of this line, `most` bytes of it unless the file ends before. Valid until the next call.
  std::string_view from_line_start(std::size_t most);

  /// How many bytes of this line have been read.
  [[nodiscard]] std::size_t bytes_read() const { return cursor_; }

  /// As `token_on_line`, but a backslash at the end of a line continues it on the next.
  std::string_view token_on_continued_line();

  /// The location of the last token; of the end of the file, if there was none.
  [[nodiscard]] Location location() const { return {.line = line_number_, .column = token_begin_ + 1}; }

  [[nodiscard]] InputBuffer& input() const { return input_; }

  /// Throws Error{code} at the location of the last token.
  [[noreturn]] void fail(ErrorCode code, std::string_view message) const {
    fail_at(input_.name(), location(), code, message);
  }

  template <class... Args>
  [[noreturn]] void malformed(fmt::format_string<Args...> format, Args&&... args) const {
    fail(ErrorCode::MalformedFile, fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  [[nodiscard]] std::size_t find_line_end();
  void take_line(std::size_t length);
  [[nodiscard]] bool ends_line(char c) const;

  InputBuffer& input_;
  TextSyntax syntax_;
  std::uint64_t line_number_;
  std::string_view line_;
  std::size_t whole_length_ = 0;  // of the line with its end
  std::size_t cursor_ = 0;
  std::size_t token_begin_ = 0;
};

}  // namespace meshhood::inline v0_1::io
