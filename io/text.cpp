// SPDX-License-Identifier: MIT
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 20;

bool is_blank(char c) { return c == ' ' || ('\t' <= c && c <= '\r'); }

}  // namespace

std::string lower_case(std::string text) {
  for (char& c : text) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

void take_byte_order_mark(InputBuffer& input) {
  const auto head = input.ahead(3);
  if (head.starts_with("\xef\xbb\xbf")) input.skip(3);
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff")) {
    raise(ErrorCode::UnsupportedFormat, input.name() + ": UTF-16 text is not supported, expected UTF-8 or ASCII");
  }
}

bool Text::next_line() {
  leave_line();
  if (input_.ahead(1).empty()) {
    token_begin_ = std::max(token_begin_, line_.size());
    line_ = {};
    cursor_ = 0;
    return false;
  }
  ++line_number_;
  token_begin_ = cursor_ = 0;
  take_line(find_line_end());
  return true;
}

void Text::skip_lines(std::size_t bytes, std::uint64_t lines) {
  const auto skipped = input_.ahead(bytes).substr(0, bytes);
  input_.skip(skipped.rfind('\n', bytes - 2) + 1);  // npos + 1 is 0
  line_number_ += lines - 1;
  next_line();
  skip_line();
}

std::string_view Text::token_on_line() {
  while (cursor_ < line_.size() && is_blank(line_[cursor_])) ++cursor_;
  token_begin_ = cursor_;
  if (syntax_.hash_comments && line_.substr(cursor_).starts_with('#')) {
    skip_line();
    return {};
  }
  while (cursor_ < line_.size() && !is_blank(line_[cursor_])) ++cursor_;
  return line_.substr(token_begin_, cursor_ - token_begin_);
}

std::string_view Text::token_on_continued_line() {
  for (;;) {
    const auto token = token_on_line();
    if (!token.ends_with('\\') || cursor_ != line_.size()) return token;
    if (token.size() > 1) {
      --cursor_;  // the backslash is the next token
      return token.substr(0, token.size() - 1);
    }
    if (!next_line()) return {};
  }
}

std::string_view Text::token() {
  for (;;) {
    const auto found = token_on_line();
    if (!found.empty() || !next_line()) return found;
  }
}

std::string_view Text::from_line_start(std::size_t most) {
  const auto seen = input_.ahead(most);
  line_ = seen.substr(0, line_.size());
  return seen.substr(0, most);
}

bool Text::at_line_end() const {
  const auto rest = line_.substr(cursor_);
  const auto next = rest.find_first_not_of(kBlanks);
  return next == std::string_view::npos || (syntax_.hash_comments && rest[next] == '#');
}

bool Text::ends_line(char c) const {
  if (c == '\0') return true;  // `take_line` refuses it
  return syntax_.line_end == kAnyLineEnd ? c == '\n' || c == '\r' : c == syntax_.line_end;
}

// The length of the line at the front of the input, without its end.
std::size_t Text::find_line_end() {
  std::size_t searched = 0;
  for (;;) {
    const auto seen = input_.ahead(searched + 1);
    const auto end = std::find_if(seen.begin() + static_cast<std::ptrdiff_t>(searched), seen.end(),
                                  [this](char c) { return ends_line(c); });
    const auto length = static_cast<std::size_t>(end - seen.begin());
    if (end != seen.end() || length == searched) return length;
    if (length >= kLongestLine) malformed("the line is longer than {} bytes", kLongestLine);
    searched = length;
  }
}

void Text::take_line(std::size_t length) {
  const auto seen = input_.ahead(length + 2);
  line_ = seen.substr(0, length);
  const auto end = seen.substr(length, 2);
  if (end.starts_with('\0')) {
    token_begin_ = length;
    malformed("found a NUL byte, expected text");
  }
  const bool pair = end == "\r\n" && syntax_.line_end == kAnyLineEnd;
  whole_length_ = length + (pair ? 2 : std::min<std::size_t>(end.size(), 1));
}

}  // namespace meshhood::inline v0_1::io
